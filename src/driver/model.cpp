#include "driver/model.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/error.h"
#include "common/parallel.h"
#include "dynamics/stable_time_step.h"
#include "mesh/gmsh_reader.h"
#include "modal/stability_limit.h"
#include "system/finite_element_system.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

/// Rank 0 reads the meshes and finds who faces whom; every rank gets its part.
void build_meshes(MPI_Comm comm, const Scene& scene, Profile& profile, Model& model) {
  std::vector<GlobalMesh> meshes(scene.structures.size());
  {
    const ScopedTimer timer(profile, Phase::mesh);
    on_rank0(comm, [&] {
      for (std::size_t s = 0; s < meshes.size(); ++s) {
        meshes[s] = read_mesh(scene.structures[s]);
      }
      model.interface = find_interface(scene, meshes);
      model.probes = resolve_probes(scene, meshes);
    });
    broadcast_interface(comm, model.interface);
    broadcast_probes(comm, model.probes);
  }
  const ScopedTimer timer(profile, Phase::partition);
  Partition partition;
  on_rank0(comm, [&] {
    partition = partition_meshes(meshes, facing_nodes(model.interface), size_of(comm));
  });
  model.partition_imbalance = partition.imbalance;
  model.partition_edge_cut = partition.edge_cut;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    model.meshes.push_back(
        distribute_mesh(comm, scene.structures[s].name, meshes[s], partition, static_cast<int>(s)));
    if (model.meshes[s].global_dofs == 0) {
      throw UserError("structure " + scene.structures[s].name +
                      ": every node is clamped, nothing can move; look at -" +
                      scene.structures[s].name + "_clamp");
    }
  }
}

void choose_time_step(const Scene& scene, Model& model) {
  const double stable = model.smallest_stable_time_step();
  if (!std::isfinite(stable) && !(scene.time_step > 0)) {
    throw UserError(
        "nothing in the scene vibrates, so nothing limits the time step: give -time_step");
  }
  model.time_step = scene.time_step > 0 ? scene.time_step : round_down(scene.courant * stable);
  if (model.time_step > stable && !scene.allow_unstable) {
    std::ostringstream text;
    text << "option -time_step " << model.time_step << " s: above the stable time step " << stable
         << " s; give a smaller one (or leave it out), or -allow_unstable for a study";
    throw UserError(text.str());
  }
  model.steps = static_cast<std::int64_t>(std::ceil(scene.end_time / model.time_step - 1e-9));
}

void find_energy_margins(Model& model) {
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    const LinearSystem& system = model.systems[s];
    model.energy_margin.push_back(
        system.extra_damping
            ? smallest_energy_margin(system, model.meshes[s], model.time_step)
            : energy_margin(system.damping, model.largest[s].omega_max, model.time_step));
  }
}

}  // namespace

double Model::smallest_stable_time_step() const {
  return *std::min_element(stable_time_step.begin(), stable_time_step.end());
}

Model build_model(MPI_Comm comm, const Scene& scene, Profile& profile) {
  Model model;
  on_every_rank(
      comm, [&] { model.motion = std::make_unique<GroundMotion>(scene.motion, scene.resampling); });
  build_meshes(comm, scene, profile, model);
  const bool exported = !scene.export_matrices.empty();
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    const Mesh& mesh = model.meshes[s];
    {
      const ScopedTimer timer(profile, Phase::assembly);
      model.systems.push_back(scene.structures[s].fidelity == Fidelity::matrices
                                  ? build_matrix_system(scene.structures[s], mesh)
                                  : build_finite_element_system(scene.structures[s], mesh,
                                                                scene.stiffness,
                                                                scene.modes > 0 || exported));
    }
    const ScopedTimer timer(profile, Phase::modes);
    const LinearSystem& system = model.systems.back();
    model.modal.push_back(lowest_modes(system, mesh, scene.modes));
    if (!exported) {
      system.stiffness->release_matrix();
    }
    model.largest.push_back(largest_frequency(system, mesh));
    model.stable_time_step.push_back(
        system.extra_damping ? stability_limit(system, mesh)
                             : stable_time_step(system.damping, model.largest.back().omega_max));
  }
  choose_time_step(scene, model);
  const ScopedTimer timer(profile, Phase::modes);
  find_energy_margins(model);
  return model;
}

}  // namespace pounding
