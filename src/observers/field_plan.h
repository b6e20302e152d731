#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/parallel.h"
#include "interactions/contact_problem.h"
#include "model/model.h"
#include "model/solver.h"
#include "observers/field_writer.h"
#include "observers/observer.h"
#include "scene/scene.h"

namespace pounding {

/// Steps between two samples of the probes.
int record_stride(const Scene& scene, const Model& model);

/// Steps between two samples of the gaps, which the probes record as well.
std::int64_t gap_stride(const Scene& scene, const Model& model);

/// Steps whose motion the scene keeps as a whole, all of which the probes record as well; nothing
/// if it keeps none. Throws UserError: the run ends before the first.
std::optional<FieldSteps> planned_fields(const Scene& scene, const Model& model);

/// Doubts about the frames of the scene: asked for more often than they come, too large to be meant
/// or for the disk. On rank 0. Collective.
std::vector<std::string> check_fields(MPI_Comm comm, const Scene& scene, const Model& model);

/// Prints how many frames there will be and the room that they take. Collective.
void print_fields(MPI_Comm comm, const Scene& scene, const Model& model);

/// Per structure of a scene, whether elements of it yield by a law with a skeleton, or crack.
std::vector<char> yielding_structures(const Scene& scene);

/// A run as its observers know it; all that is referred to outlives them.
struct ObservedRun {
  MPI_Comm comm;
  const Scene& scene;
  const Model& model;
  Solver& solver;

  /// The rank that knows gaps and impulses, -1 without contacts.
  int contact_root() const { return solver.contact() != nullptr ? solver.contact()->root() : -1; }
  bool is_contact_root() const { return rank_of(comm) == contact_root(); }
  std::vector<std::string> contact_names() const {
    std::vector<std::string> names;
    for (const Contact& contact : scene.contacts) names.push_back(contact.name);
    return names;
  }
  /// The first step from `step` on with a record of the history.
  std::int64_t next_record_step(std::int64_t step) const {
    return next_multiple(step, record_stride(scene, model));
  }
  /// The first step from `step` on with a line of the energy ledger.
  std::int64_t next_ledger_step(std::int64_t step) const {
    const std::int64_t first = std::max<std::int64_t>(step, 1);
    if (first > model.steps) return Observer::never;
    return std::min(next_multiple(first, scene.energy_interval), model.steps);
  }
};

}  // namespace pounding
