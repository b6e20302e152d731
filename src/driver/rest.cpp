#include "driver/rest.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <utility>

#include "common/progress.h"
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
  return length(rest.weight) == 0;
}

void print_force(const char* what, const Vector3& force) {
  std::printf("    %-22s (%.6g, %.6g, %.6g) N\n", what, force[0], force[1], force[2]);
}

}  // namespace

void put_at_rest(MPI_Comm comm, const Scene& scene, Profile& profile, Model& model) {
  if (!scene.preload) return;
  const ScopedTimer timer(profile, Phase::assembly);
  const Progress progress(comm, "static equilibrium", scene.progress_interval);
  model.equilibrium =
      find_equilibrium(comm, model.systems, model.meshes, model.interface,
                       rows_open_at_rest(scene, model.interface), scene.preload_solver);
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    model.systems[s].rest_displacement = std::move(model.equilibrium->displacement[s]);
    if (scene.export_matrices.empty()) model.systems[s].stiffness->release_matrix();
  }
  model.equilibrium->displacement.clear();
}

std::vector<std::string> rest_warnings(const Model& model) {
  std::vector<std::string> warnings;
  if (model.equilibrium && std::ranges::all_of(model.equilibrium->structures, is_weightless)) {
    warnings.emplace_back(
        "-preload static, and no structure has a weight: the run starts undeformed; give -gravity "
        "9.81");
  }
  for (std::size_t s = 0; model.equilibrium && s < model.systems.size(); ++s) {
    const StructureRest& rest = model.equilibrium->structures[s];
    const double settlement = std::max(rest.largest_displacement, length(rest.settlement));
    std::ostringstream text;
    if (settlement > small_settlement * model.interface.model_size) {
      text << "structure " << model.systems[s].name << " settles by " << settlement
           << " m under its weight: displacements are taken for small; are its stiffness and its "
              "density in SI units?";
    } else if (rest.imbalance > small_imbalance) {
      text << "structure " << model.systems[s].name << ": the forces that hold it miss its weight "
           << "by " << rest.imbalance << " of it";
    }
    if (!text.str().empty()) warnings.push_back(text.str());
  }
  if (model.equilibrium && model.equilibrium->residual > small_residual) {
    std::ostringstream text;
    text << "the static equilibrium is found to " << model.equilibrium->residual
         << " of the weight only, by energy: round-off of very stiff elements; the run starts as "
            "far "
            "from rest";
    warnings.push_back(text.str());
  }
  return warnings;
}

std::vector<ContactLoad> contact_loads(const Scene& scene, const Model& model) {
  std::vector<ContactLoad> loads(scene.contacts.size());
  for (std::size_t row = 0; row < model.equilibrium->contact_force.size(); ++row) {
    const double force = model.equilibrium->contact_force[row];
    ContactLoad& load = loads[model.interface.constraints[row].contact];
    load.force += force;
    load.closed += force > 0 ? 1 : 0;
    ++load.points;
  }
  return loads;
}

void print_rest(const Scene& scene, const Model& model) {
  if (!model.equilibrium) return;
  const Equilibrium& rest = *model.equilibrium;
  std::printf(
      "\nstatic equilibrium: %d iterations, %.1e of the weight left, %d contact points and links "
      "tried\n",
      rest.iterations, rest.residual, rest.rows_tried);
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    const StructureRest& of = rest.structures[s];
    std::printf("  structure %s, %s\n", model.systems[s].name.c_str(), of.method.c_str());
    print_force("weight", of.weight);
    print_force("supports push it by", of.support);
    if (!scene.structures[s].clamps.empty()) {
      std::printf("      with the loads on held nodes, which recorded reactions are without\n");
    }
    if (!scene.contacts.empty()) print_force("contacts push it by", of.contact);
    std::printf("    %-22s (%.4g, %.4g, %.4g) mm in the mean", "settles by",
                1000 * of.settlement[0], 1000 * of.settlement[1], 1000 * of.settlement[2]);
    if (!of.place.empty()) {
      std::printf(", at most %.4g mm at %s", 1000 * of.largest_displacement, of.place.c_str());
    }
    std::printf("\n");
    if (!model.systems[s].generalised) {
      std::printf("    their sum is zero within %.1e of the largest\n", of.imbalance);
    }
  }
  const std::vector<ContactLoad> loads = contact_loads(scene, model);
  for (std::size_t c = 0; c < loads.size(); ++c) {
    std::printf("  contact %s: %d of %d points carry %.6g N\n", scene.contacts[c].name.c_str(),
                loads[c].closed, loads[c].points, loads[c].force);
  }
  if (rest.acting_links + rest.idle_links > 0) {
    std::printf("  tension-only bars and compression-only springs: %d act, %d do not\n",
                rest.acting_links, rest.idle_links);
  }
}

}  // namespace pounding
