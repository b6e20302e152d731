#pragma once

#include <array>
#include <span>
#include <vector>

#include "dynamics/batch_step.h"
#include "mesh/probe_set.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding {

/// A vector of a state, of a batch and of one run.
struct StatePart {
  std::vector<BatchValue> StateOf<BatchValue>::*of_batch;
  std::vector<double> StructureState::*of_run;
};
constexpr StatePart displacements{&StateOf<BatchValue>::displacement,
                                  &StructureState::displacement};
constexpr StatePart velocities{&StateOf<BatchValue>::velocity, &StructureState::velocity};

/// The states of one structure in up to eight runs, wherever they are stepped.
struct StatesOfRuns {
  const BatchStep* batch = nullptr;                     ///< null: each run steps its own
  std::array<const StructureState*, batch_size> own{};  ///< null beyond the last run

  /// Value of a coordinate in every run.
  BatchValue value(const StatePart& part, std::size_t i) const;
};

/// Rows over the coordinates of one structure, of displacements at places of its mesh: of
/// generalised coordinates whole ones, at full order a few dofs.
class CoordinateRows {
 public:
  /// `system`: of any of the runs.
  CoordinateRows(std::size_t rows, const LinearSystem& system);
  std::size_t rows() const { return rows_; }

  /// row += factor * (known point k of a trace) / divisor.
  void add(std::size_t row, double factor, const Trace& trace, std::size_t k, double divisor = 1);
  /// products := rows times a part of the states. Allocates nothing.
  void multiply(const StatesOfRuns& states, const StatePart& part, BatchValue* products) const;
  /// One row times the coordinates `x` of one run.
  double product(std::size_t row, std::span<const double> x) const;

 private:
  struct Entry {
    std::size_t row = 0;
    LocalIndex dof = 0;
    double coefficient = 0;
  };
  std::size_t rows_;
  std::size_t width_ = 0;       ///< generalised coordinates; 0 at full order
  std::vector<double> values_;  ///< of these, shape (rows, width)
  std::vector<Entry> entries_;  ///< at full order
};

/// Means of probes on one structure, whose places `trace` has, as rows: those of probe_means.
CoordinateRows mean_rows(std::span<const ResolvedProbe* const> probes, const LinearSystem& system,
                         const Trace& trace);

}  // namespace pounding
