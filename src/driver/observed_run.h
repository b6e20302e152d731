#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/parallel.h"
#include "driver/field_plan.h"
#include "driver/model.h"
#include "driver/solver.h"
#include "output/observer.h"
#include "scene/scene.h"

namespace pounding {

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
