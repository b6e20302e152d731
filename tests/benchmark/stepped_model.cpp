#include "benchmark/stepped_model.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "benchmark/storey_pair.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "stability/stable_time_step.h"
#include "support/box_mesh.h"
#include "system/finite_element_system.h"

namespace pounding::measuring {
namespace {

constexpr Vector3 cell_size{0.12, 0.12, 0.22};  // of the brick [m]
constexpr Rayleigh damping{0.1562, 1.2557e-5};
constexpr double courant = 0.9;

Structure concrete_structure(const std::string& name) {
  Structure structure = testing::solid_structure(name, 30e9, 0.2, 2400);
  structure.damping = damping;
  return structure;
}

/// The meshes as rank 0 sees them before they are distributed.
std::vector<GlobalMesh> make_meshes(const ModelRequest& request, Interface& interface) {
  std::vector<GlobalMesh> meshes;
  if (request.cells_per_metre > 0) {
    StoreyPair pair = build_storey_pair(request.cells_per_metre);
    interface = std::move(pair.interface);
    std::move(pair.meshes.begin(), pair.meshes.end(), std::back_inserter(meshes));
    return meshes;
  }
  Vector3 size{};
  for (std::size_t d = 0; d < 3; ++d) {
    size[d] = cell_size[d] * request.cells[d];
  }
  meshes.push_back(testing::box_mesh({0, 0, 0}, size, request.cells));
  testing::clamp(meshes.back(), "x_min");
  return meshes;
}

void distribute(MPI_Comm comm, const ModelRequest& request, SteppedModel& model) {
  std::vector<GlobalMesh> meshes(request.cells_per_metre > 0 ? 2 : 1);
  Partition partition;
  on_rank0(comm, [&] {
    meshes = make_meshes(request, model.interface);
    partition = partition_meshes(meshes, facing_nodes(model.interface), size_of(comm));
  });
  broadcast_interface(comm, model.interface);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    model.meshes.push_back(distribute_mesh(comm, "s" + std::to_string(s + 1), meshes[s], partition,
                                           static_cast<int>(s)));
  }
}

std::unique_ptr<GroundMotion> read_motion(const ModelRequest& request) {
  const MotionComponent component{RecordedMotion{request.motion, "m/s2", request.motion_step, 0}};
  return std::make_unique<GroundMotion>(
      std::array<std::optional<MotionComponent>, 3>{component, component, component},
      Resampling::linear);
}

}  // namespace

GlobalIndex SteppedModel::global_dofs() const {
  GlobalIndex dofs = 0;
  for (const LinearSystem& system : systems) {
    dofs += system.global_dofs;
  }
  return dofs;
}

SteppedModel build_stepped_model(MPI_Comm comm, const ModelRequest& request,
                                 StiffnessMethod method) {
  SteppedModel model;
  model.comm = comm;
  on_every_rank(comm, [&] { model.motion = read_motion(request); });
  distribute(comm, request, model);
  double stable = std::numeric_limits<double>::infinity();
  for (const Mesh& mesh : model.meshes) {
    model.systems.push_back(
        build_finite_element_system(concrete_structure(mesh.structure), mesh, method));
    const LinearSystem& system = model.systems.back();
    stable = std::min(stable, stable_time_step(system.damping, system.element_frequency_bound));
  }
  model.time_step = round_down(courant * stable);
  return_freed_memory();
  return model;
}

}  // namespace pounding::measuring
