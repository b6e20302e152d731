#pragma once

#include <memory>
#include <string>

#include "benchmark/stepped_model.h"

namespace pounding::measuring {

/// One way of carrying out the step; starts from rest, and each call goes on where the last ended.
class TimedStep {
 public:
  virtual ~TimedStep() = default;
  /// Collective.
  virtual void run(long steps) = 0;
  /// Sum of the squares of this rank's displacements [m2]: the ways must agree.
  virtual double displacement_square() const = 0;
  /// Time that this rank has spent on contact in all steps so far [s].
  virtual double contact_seconds() const { return 0; }
};

/// The program's own step: its stepper, contact with a look at the gap in every step if the model
/// has any, the energy ledger at its usual interval. `model` must outlive it. Collective.
std::unique_ptr<TimedStep> make_program_step(const SteppedModel& model);

/// The same scheme written out around PETSc's MatMult, without ledger; `type` is MATAIJ, which is
/// the model's assembled matrix, MATBAIJ or MATSBAIJ with blocks of 3. For a model of one structure
/// with an assembled matrix and three components free at every node, which must outlive it.
/// Collective.
std::unique_ptr<TimedStep> make_matrix_step(const SteppedModel& model, const std::string& type);

}  // namespace pounding::measuring
