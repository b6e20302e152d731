#include "mesh/probe_set.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "common/error.h"
#include "mesh/element_checks.h"

namespace pounding {
namespace {

/// A node that a probe records, and how it was found.
struct ProbeNode {
  GlobalIndex node = 0;
  double snap_distance = 0;  ///< to the point asked for [m]
  double element_size = 0;   ///< of the elements there [m]
};

ProbeNode nearest_node(const GlobalMesh& mesh, const Probe& probe, const Vector3& point) {
  constexpr double far = 0.05;        // of the extent of the mesh
  constexpr double round_off = 1e-9;  // m
  GlobalIndex best = 0;
  double best_distance = std::numeric_limits<double>::max();
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    const double d = distance(mesh.position(node), point);
    if (d < best_distance - round_off) {
      best_distance = d;
      best = node;
    }
  }
  best_distance = best_distance < round_off ? 0 : best_distance;
  double farthest = far * bounding_box({&mesh, 1}).diagonal();
  const double size = best_distance > 0 ? element_size_at(mesh, best) : 0;
  if (size > 0) farthest = std::min(farthest, size);
  if (best_distance > farthest) {
    std::ostringstream text;
    text << "option -" << probe.name << "_at: the point (" << point[0] << ", " << point[1] << ", "
         << point[2] << ") is " << best_distance << " m away from the nearest node of structure "
         << probe.structure << "; give a point on the mesh";
    throw UserError(text.str());
  }
  return {best, best_distance, size > 0 ? size : farthest};
}

std::vector<ProbeNode> probe_nodes(const Probe& probe, const GlobalMesh& mesh) {
  std::vector<ProbeNode> nodes;
  if (probe.group.empty()) {
    for (const Vector3& point : probe.points) nodes.push_back(nearest_node(mesh, probe, point));
    return nodes;
  }
  const auto found = mesh.groups.find(probe.group);
  if (found == mesh.groups.end() || found->second.nodes.empty()) {
    throw UserError("option -" + probe.name + "_group: group '" + probe.group +
                    "' is not in the mesh of " + probe.structure +
                    ", which has: " + group_names(mesh));
  }
  for (const GlobalIndex node : found->second.nodes) nodes.push_back({node, 0, 0});
  return nodes;
}

ResolvedProbe resolved(const std::string& name, int structure, const GlobalMesh& mesh,
                       std::span<const ProbeNode> nodes) {
  ResolvedProbe probe;
  probe.name = name;
  probe.structure = structure;
  for (const ProbeNode& each : nodes) {
    probe.nodes.push_back(each.node);
    const Vector3 x = mesh.position(each.node);
    for (std::size_t d = 0; d < 3; ++d) {
      probe.position[d] += x[d] / static_cast<double>(nodes.size());
    }
    if (each.snap_distance > probe.snap_distance) {
      probe.snap_distance = each.snap_distance;
      probe.element_size = each.element_size;
    }
  }
  return probe;
}

}  // namespace

std::vector<ResolvedProbe> resolve_probes(const Scene& scene, std::span<const GlobalMesh> meshes) {
  std::vector<ResolvedProbe> probes;
  for (const Probe& probe : scene.probes) {
    std::size_t structure = 0;
    while (scene.structures[structure].name != probe.structure) ++structure;
    const GlobalMesh& mesh = meshes[structure];
    const std::vector<ProbeNode> nodes = probe_nodes(probe, mesh);
    const int index = static_cast<int>(structure);
    if (probe.average || nodes.size() == 1) {
      probes.push_back(resolved(probe.name, index, mesh, nodes));
      continue;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      probes.push_back(
          resolved(probe.name + "." + std::to_string(i + 1), index, mesh, {&nodes[i], 1}));
    }
  }
  return probes;
}

}  // namespace pounding
