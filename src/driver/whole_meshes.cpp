#include "driver/whole_meshes.h"

#include <algorithm>

#include "checks/mesh_checks.h"
#include "checks/model_doubts.h"
#include "checks/warnings.h"
#include "common/progress.h"
#include "interactions/pairing/absorbing_faces.h"
#include "interactions/pairing/find_soil_rows.h"
#include "mesh/find_supported_nodes.h"
#include "mesh/gmsh_reader.h"
#include "mesh/order_bearings.h"
#include "mesh/soil_node.h"
#include "mesh/start_states.h"
#include "model/applied_loads.h"
#include "scene/pool_reader.h"
#include "scene/soil_file.h"
#include "scene/soil_reader.h"
#include "system/mass_scaling.h"

namespace pounding {
namespace {

/// Refuses faults of a mesh, keeps its findings for the report. Matrices from files hold and join
/// as they like.
void check_mesh(const Scene& scene, std::size_t s, const GlobalMesh& mesh, Model& model) {
  const Structure& structure = scene.structures[s];
  MeshFindings& findings = model.buildings[s].findings;
  findings.connectivity = examine_connectivity(structure, mesh);
  findings.unused = check_unused(scene, structure, mesh);
  findings.waves = mesh_waves(structure, mesh);
  check_export(scene, structure, mesh);
  if (structure.matrices.empty()) check_connectivity(scene, structure, findings.connectivity);
  add_mesh_doubts(scene, structure, mesh, findings.connectivity, model.warnings);
}

/// Takes the mesh of a structure, the next of `reader`, lays its soil under the mat and finds its
/// nodes on absorbing faces, spread springs and supports. `comm`: for lines of progress. Throws
/// UserError. Rank 0.
void read_whole_mesh(MPI_Comm comm, Scene& scene, std::size_t s, MeshReader& reader,
                     WholeMeshes& whole, Model& model) {
  Structure& structure = scene.structures[s];
  GlobalMesh& mesh = whole.meshes[s];
  const Progress progress(comm, structure.name + ": mesh", scene.progress_interval);
  read_soil_file(structure);
  Doubts(model.warnings).add(fit_doubts(structure));
  MeshRead read = reader.next();
  mesh = std::move(read.mesh);
  model.buildings[s].findings.files = std::move(read.files);
  model.buildings[s].findings.divided = std::move(read.divided);
  if (structure.soil) {
    whole.mats[s] = mat_outline(structure, mesh);
    lay_foundation(whole.mats[s], structure);
  }
  whole.pools[s] = mesh.pools;
  fill_pools(whole.pools[s], structure);
  model.buildings[s].absorbing = interactions::find_absorbing_nodes(scene, structure, mesh);
  model.buildings[s].spread = find_spread_springs(mesh);
  order_sliding_bearings(structure, mesh);
  find_supported_nodes(scene, structure, mesh);
}

}  // namespace

WholeMeshes read_whole_meshes(MPI_Comm comm, Scene& scene, Model& model, int splits) {
  const std::size_t count = scene.structures.size();
  WholeMeshes whole{std::vector<GlobalMesh>(count), std::vector<MatOutline>(count),
                    std::vector<std::vector<PoolOutline>>(count), splits};
  std::vector<const Structure*> structures;
  for (const Structure& structure : scene.structures) structures.push_back(&structure);
  MeshReader reader(std::move(structures), scene.meshes.time_limit, splits, scene.kept);
  for (std::size_t s = 0; s < count; ++s) {
    read_whole_mesh(comm, scene, s, reader, whole, model);
    check_mesh(scene, s, whole.meshes[s], model);
  }
  if (std::ranges::any_of(model.buildings,
                          [](const Building& b) { return !b.findings.files.landlock; })) {
    model.warnings.emplace_back(
        "this system has no Landlock: the commands of a .geo file were held back by seccomp alone");
  }
  const Progress progress(comm, "faces in contact and probes", scene.progress_interval);
  model.interface = interactions::find_interface(scene, whole.meshes);
  model.interface.soil = interactions::find_soil_rows(scene, whole.meshes);
  model.probes = resolve_probes(scene, whole.meshes);
  model.recorded = with_rotations(scene, whole.meshes, model.probes);
  model.forces = resolve_forces(scene, whole.meshes);
  model.loads = find_loads(scene, whole.meshes);
  model.starts = find_start_states(scene, whole.meshes);
  Doubts(model.warnings).add(load_doubts(scene, whole.meshes, model.loads));
  add_probe_doubts(model.probes, whole.meshes, model.interface, model.warnings);
  add_place_doubts(scene, whole.meshes, model.interface, model.probes, model.warnings);
  return whole;
}

std::vector<int> owners_of_reduced(int ranks, const Scene& scene) {
  const auto count = static_cast<int>(std::ranges::count_if(
      scene.structures, [](const Structure& structure) { return structure.modal.has_value(); }));
  const int block = (count + ranks - 1) / ranks;
  std::vector<int> owners;
  int reduced = 0;
  for (const Structure& structure : scene.structures) {
    owners.push_back(structure.modal ? reduced++ / block : -1);
  }
  return owners;
}

Partition cut_meshes(const Scene& scene, std::span<const GlobalMesh> meshes,
                     const interactions::Interface& interface, int parts) {
  std::vector<NodeCluster> clusters;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    if (scene.structures[s].modal) continue;  // coordinates are scaled, not elements
    const auto more = coupled_nodes(scene.structures[s], meshes[s], static_cast<int>(s));
    clusters.insert(clusters.end(), more.begin(), more.end());
  }
  return partition_meshes(meshes, interactions::facing_nodes(interface), parts,
                          owners_of_reduced(parts, scene), clusters, scene.partition_by);
}

}  // namespace pounding
