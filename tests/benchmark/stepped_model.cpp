#include "benchmark/stepped_model.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "benchmark/storey_pair.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "driver/build_model.h"
#include "scene/options_database.h"
#include "scene/scene_reader.h"
#include "stability/stable_time_step.h"
#include "support/box_mesh.h"
#include "system/finite_element_system.h"

namespace pounding::measuring {
namespace {

constexpr Rayleigh damping{0.1562, 1.2557e-5};
constexpr double courant = 0.9;

Structure concrete_structure(const std::string& name, const ModelRequest& request) {
  const bool plate = request.cells[0] > 0 && request.cells[2] == 0;
  Structure structure = testing_support::solid_structure(
      name, 30e9, 0.2, 2400, plate ? ElementType::shell4 : ElementType::hex8);
  structure.regions[0].thickness = cell_size[2];
  structure.damping = damping;
  return structure;
}

/// A plate clamped at x = 0.
GlobalMesh plate_mesh(int nx, int ny) {
  GlobalMesh mesh;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      mesh.node_tags.push_back(mesh.node_count() + 1);
      mesh.coordinates.insert(mesh.coordinates.end(), {cell_size[0] * i, cell_size[1] * j, 0.0});
      mesh.free_components.push_back(i == 0 ? 0 : 0x3f);
    }
  }
  mesh.components.assign(mesh.node_tags.size(), 0x3f);
  ElementSet set;
  set.group = "body";
  set.type = ElementType::shell4;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      set.tags.push_back(static_cast<std::int64_t>(set.tags.size()) + 1);
      const int first = j * (nx + 1) + i;
      for (const int node : {first, first + 1, first + nx + 2, first + nx + 1}) {
        set.connectivity.push_back(node);
      }
    }
  }
  mesh.regions.push_back(std::move(set));
  return mesh;
}

/// The meshes as rank 0 sees them before they are distributed.
std::vector<GlobalMesh> make_meshes(const ModelRequest& request,
                                    interactions::Interface& interface) {
  std::vector<GlobalMesh> meshes;
  if (request.cells_per_metre > 0) {
    StoreyPair pair = build_storey_pair(request.cells_per_metre);
    interface = std::move(pair.interface);
    std::move(pair.meshes.begin(), pair.meshes.end(), std::back_inserter(meshes));
    return meshes;
  }
  if (request.cells[2] == 0) {
    meshes.push_back(plate_mesh(request.cells[0], request.cells[1]));
    return meshes;
  }
  Vector3 size{};
  for (std::size_t d = 0; d < 3; ++d) {
    size[d] = cell_size[d] * request.cells[d];
  }
  meshes.push_back(testing_support::box_mesh({0, 0, 0}, size, request.cells));
  testing_support::clamp(meshes.back(), "x_min");
  return meshes;
}

void distribute(MPI_Comm comm, const ModelRequest& request, SteppedModel& model) {
  std::vector<GlobalMesh> meshes(request.cells_per_metre > 0 ? 2 : 1);
  Partition partition;
  on_rank0(comm, [&] {
    meshes = make_meshes(request, model.interface);
    partition =
        partition_meshes(meshes, interactions::facing_nodes(model.interface), size_of(comm));
  });
  broadcast_values(comm, 0, model.interface);
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

/// The model of a scene, as the program builds it.
SteppedModel scene_model(MPI_Comm comm, const ModelRequest& request, StiffnessMethod method) {
  CommandLine line;
  line.files = {request.scene};
  Scene scene = read_scene(read_options_database(comm, line)).scene;
  scene.stiffness = method;
  scene.modes = 0;
  Profile profile;
  Model built =
      build_model(comm, scene, std::vector<double>(scene.structures.size(), 1.0), profile);
  SteppedModel model;
  model.comm = comm;
  model.structures = std::move(scene.structures);
  model.meshes = std::move(built.meshes);
  model.systems = std::move(built.systems);
  model.interface = std::move(built.interface);
  model.contacts = std::move(scene.contacts);
  model.motion = std::move(built.motion);
  model.supports = std::move(built.supports);
  model.time_step = built.time_step;
  return model;
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
  if (!request.scene.empty()) return scene_model(comm, request, method);
  SteppedModel model;
  model.comm = comm;
  on_every_rank(comm, [&] { model.motion = read_motion(request); });
  distribute(comm, request, model);
  double stable = std::numeric_limits<double>::infinity();
  for (const Mesh& mesh : model.meshes) {
    model.structures.push_back(concrete_structure(mesh.structure, request));
    model.systems.push_back(pounding::build_system(model.structures.back(), mesh, method));
    const LinearSystem& system = model.systems.back();
    stable = std::min(stable, stable_time_step(system.damping, system.element_frequency_bound));
  }
  model.time_step = round_down(courant * stable);
  return_freed_memory();
  return model;
}

}  // namespace pounding::measuring
