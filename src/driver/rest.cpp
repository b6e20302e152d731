#include "driver/rest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/progress.h"
#include "driver/facts.h"
#include "driver/rest_gaps.h"

namespace pounding {
namespace {

/// Part of the model's size that a settlement may be.
constexpr double small_settlement = 0.01;

constexpr double small_imbalance = 1e-8;
constexpr double small_residual = 1e-8;

double length(const Vector3& v) {
  return std::hypot(v[0], v[1], v[2]);
}

bool is_weightless(const StructureRest& rest) {
  return length(rest.weight) == 0 && length(rest.load) == 0;
}

}  // namespace

void put_at_rest(MPI_Comm comm, const Scene& scene, std::span<const Mesh> meshes, Profile& profile,
                 Model& model) {
  if (!scene.preload) return;
  const ScopedTimer timer(profile, Phase::assembly);
  const Progress progress(comm, "static equilibrium", scene.progress_interval);
  model.equilibrium =
      find_equilibrium(comm, model.systems, meshes, model.interface,
                       rows_open_at_rest(scene, model.interface), scene.preload_solver);
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    model.systems[s].rest_displacement = std::move(model.equilibrium->displacement[s]);
    model.systems[s].rest_law_force = std::move(model.equilibrium->law_force[s]);
    if (scene.export_matrices.empty()) model.systems[s].stiffness->release_matrix();
  }
  model.equilibrium->displacement.clear();
  model.equilibrium->law_force.clear();
}

std::vector<std::string> rest_warnings(const Model& model) {
  std::vector<std::string> warnings;
  if (model.equilibrium && std::ranges::all_of(model.equilibrium->structures, is_weightless)) {
    warnings.emplace_back(
        "-preload static, and no structure has a weight or a load at rest: the run starts "
        "undeformed; give -gravity 9.81");
  }
  for (std::size_t s = 0; model.equilibrium && s < model.systems.size(); ++s) {
    const StructureRest& rest = model.equilibrium->structures[s];
    const double settlement = std::max(rest.largest_displacement, length(rest.settlement));
    const std::string& name = model.systems[s].name;
    if (settlement > small_settlement * model.interface.model_size) {
      warnings.push_back(
          sentence("structure {} settles by {} m under its weight and loads: displacements are "
                   "taken for small; are its stiffness and its density in SI units?",
                   {name, settlement}));
    } else if (rest.imbalance > small_imbalance) {
      warnings.push_back(
          sentence("structure {}: the forces that hold it miss its weight by {} of it",
                   {name, rest.imbalance}));
    }
  }
  if (model.equilibrium && model.equilibrium->residual > small_residual) {
    warnings.push_back(sentence(
        "the static equilibrium is found to {} of the weight only, by energy: round-off of very "
        "stiff elements; the run starts as far from rest",
        {model.equilibrium->residual}));
  }
  return warnings;
}

}  // namespace pounding
