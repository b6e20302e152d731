#include "output/probe_set.h"

#include <limits>
#include <sstream>

#include "common/error.h"
#include "common/parallel.h"
#include "mesh/bounding_box.h"
#include "mesh/group_names.h"

namespace pounding {
namespace {

GlobalIndex nearest_node(const GlobalMesh& mesh, const Probe& probe, const Vector3& point) {
  GlobalIndex best = 0;
  double best_distance = std::numeric_limits<double>::max();
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    const double d = distance(mesh.position(node), point);
    if (d < best_distance - 1e-9) {
      best_distance = d;
      best = node;
    }
  }
  if (best_distance > 0.05 * bounding_box({&mesh, 1}).diagonal()) {
    std::ostringstream text;
    text << "option -" << probe.name << "_at: the point (" << point[0] << ", " << point[1] << ", "
         << point[2] << ") is " << best_distance << " m away from the nearest node of structure "
         << probe.structure << "; give a point on the mesh";
    throw UserError(text.str());
  }
  return best;
}

std::vector<GlobalIndex> probe_nodes(const Probe& probe, const GlobalMesh& mesh) {
  if (probe.group.empty()) {
    std::vector<GlobalIndex> nodes;
    for (const Vector3& point : probe.points) {
      nodes.push_back(nearest_node(mesh, probe, point));
    }
    return nodes;
  }
  const auto found = mesh.groups.find(probe.group);
  if (found == mesh.groups.end() || found->second.nodes.empty()) {
    throw UserError("option -" + probe.name + "_group: group '" + probe.group +
                    "' is not in the mesh of " + probe.structure +
                    ", which has: " + group_names(mesh));
  }
  return found->second.nodes;
}

ResolvedProbe resolved(const std::string& name, int structure, const GlobalMesh& mesh,
                       std::vector<GlobalIndex> nodes) {
  ResolvedProbe probe{name, structure, std::move(nodes), {0, 0, 0}};
  for (const GlobalIndex node : probe.nodes) {
    const Vector3 x = mesh.position(node);
    for (std::size_t d = 0; d < 3; ++d) {
      probe.position[d] += x[d] / static_cast<double>(probe.nodes.size());
    }
  }
  return probe;
}

}  // namespace

std::vector<ResolvedProbe> resolve_probes(const Scene& scene, std::span<const GlobalMesh> meshes) {
  std::vector<ResolvedProbe> probes;
  for (const Probe& probe : scene.probes) {
    std::size_t structure = 0;
    while (scene.structures[structure].name != probe.structure) {
      ++structure;
    }
    const GlobalMesh& mesh = meshes[structure];
    const std::vector<GlobalIndex> nodes = probe_nodes(probe, mesh);
    const int index = static_cast<int>(structure);
    if (probe.average || nodes.size() == 1) {
      probes.push_back(resolved(probe.name, index, mesh, nodes));
      continue;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      probes.push_back(resolved(probe.name + "." + std::to_string(i + 1), index, mesh, {nodes[i]}));
    }
  }
  return probes;
}

void broadcast_probes(MPI_Comm comm, std::vector<ResolvedProbe>& probes) {
  int count = static_cast<int>(probes.size());
  MPI_Bcast(&count, 1, MPI_INT, 0, comm);
  probes.resize(static_cast<std::size_t>(count));
  for (ResolvedProbe& probe : probes) {
    broadcast(comm, probe.name);
    MPI_Bcast(&probe.structure, 1, MPI_INT, 0, comm);
    broadcast_array(comm, probe.nodes);
    MPI_Bcast(probe.position.data(), 3, MPI_DOUBLE, 0, comm);
  }
}

}  // namespace pounding
