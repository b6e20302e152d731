#include "mesh/probe_set.h"

#include <algorithm>
#include <limits>
#include <set>

#include "common/error.h"
#include "common/facts.h"
#include "mesh/element_checks.h"
#include "scene/law_kinds.h"

namespace pounding {
namespace {

/// A point that the user gave, brought to the nearest node of a mesh.
struct SnappedPoint {
  GlobalIndex node = 0;
  double distance = 0;      ///< to the point asked for [m]
  double element_size = 0;  ///< of the elements there [m]
};

SnappedPoint nearest_node(const GlobalMesh& mesh, const std::string& option,
                          const std::string& structure, const Vector3& point) {
  constexpr double far = 0.05;        // of the extent of the mesh
  constexpr double round_off = 1e-9;  // m
  refuse_if(mesh.node_count() == 0,
            "option -" + option + ": structure " + structure +
                " has no element of its mesh, whose nodes could be near points");
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
  refuse_if(best_distance > farthest,
            sentence("option -{}: the point {} is {} m away from the nearest node of structure {}; "
                     "give a point on the mesh",
                     {option, place_text(point), best_distance, structure}));
  return {best, best_distance, size > 0 ? size : farthest};
}

std::vector<SnappedPoint> probe_nodes(const Probe& probe, const GlobalMesh& mesh) {
  std::vector<SnappedPoint> nodes;
  if (probe.group.empty()) {
    for (const Vector3& point : probe.points) {
      nodes.push_back(nearest_node(mesh, probe.name + "_at", probe.structure, point));
    }
    return nodes;
  }
  const auto found = mesh.groups.find(probe.group);
  refuse_if(found == mesh.groups.end() || found->second.nodes.empty(),
            "option -" + probe.name + "_group: group '" + probe.group + "' is not in the mesh of " +
                probe.structure + ", which has: " + group_names(mesh));
  for (const GlobalIndex node : found->second.nodes) nodes.push_back({node, 0, 0});
  return nodes;
}

ResolvedProbe resolved(const std::string& name, int structure, const GlobalMesh& mesh,
                       std::span<const SnappedPoint> nodes) {
  ResolvedProbe probe;
  probe.name = name;
  probe.structure = structure;
  for (const SnappedPoint& each : nodes) {
    probe.nodes.push_back(each.node);
    if (each.distance > probe.snap_distance) {
      probe.snap_distance = each.distance;
      probe.element_size = each.element_size;
    }
  }
  probe.position = centroid(mesh, probe.nodes);
  return probe;
}

/// A node and all others of the elements at it.
std::vector<GlobalIndex> nodes_around(const GlobalMesh& mesh, GlobalIndex node) {
  std::set<GlobalIndex> found{node};
  for (const auto& corners : elements_at(mesh, node)) found.insert(corners.begin(), corners.end());
  return {found.begin(), found.end()};
}

/// The rotation of the rigid body nearest to the displacements u_i of n nodes at r_i from their
/// middle is the mean of n J^-1 (r_i x u_i), J = sum |r_i|^2 I - r_i r_i^T: these factors of u_i.
/// Empty where the nodes lie on a line.
std::vector<Matrix3> rigid_rotation(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes) {
  const Vector3 middle = centroid(mesh, nodes);
  Matrix3 moment{};  // J / n
  for (const GlobalIndex node : nodes) {
    const Vector3 r = minus(mesh.position(node), middle);
    for (std::size_t i = 0; i < 9; ++i) {
      const double entry = (i % 4 == 0 ? dot(r, r) : 0) - r[i / 3] * r[i % 3];
      moment[i / 3][i % 3] += entry / static_cast<double>(nodes.size());
    }
  }
  const double trace = moment[0][0] + moment[1][1] + moment[2][2];
  if (!(determinant(moment) > 1e-6 * trace * trace * trace)) return {};
  const Matrix3 turned = inverse(moment);
  std::vector<Matrix3> weights;
  for (const GlobalIndex node : nodes) {
    const Vector3 r = minus(mesh.position(node), middle);
    weights.push_back({cross(turned[0], r), cross(turned[1], r), cross(turned[2], r)});
  }
  return weights;
}

}  // namespace

std::vector<ResolvedProbe> with_rotations(const Scene& scene, std::span<const GlobalMesh> meshes,
                                          std::vector<ResolvedProbe> probes) {
  for (const Span& span : scene.spans) {
    const auto refuse = [&](const std::string& why) {
      throw UserError("span " + span.name + ": " + why);
    };
    for (const std::string& name : {span.from, span.to}) {
      const auto probe = std::ranges::find(probes, name, &ResolvedProbe::name);
      if (probe == probes.end()) refuse("no probe " + name + " with one record is in -probes");
      ResolvedProbe end = *probe;
      const GlobalMesh& mesh = meshes[end.structure];
      const bool own = std::ranges::all_of(end.nodes, [&](GlobalIndex node) {
        return (mesh.components[node] & rotation_bits) == rotation_bits;
      });
      if (!own && end.nodes.size() == 1) end.nodes = nodes_around(mesh, end.nodes[0]);
      if (!own || end.nodes.size() > 1) end.weights = rigid_rotation(mesh, end.nodes);
      end.component = end.weights.empty() ? 3 : 0;
      if (end.component == 3 && !own) refuse("nodes at " + name + " are on a line and do not turn");
      end.of = static_cast<int>(probe - probes.begin());
      end.name = span.name + "." + name;
      probes.push_back(std::move(end));
    }
    if (const int s = probes.back().structure; s == probes[probes.size() - 2].structure) {
      refuse("both ends are on structure " + scene.structures[s].name + "; give one on another");
    }
  }
  return probes;
}

std::vector<ResolvedProbe> resolve_probes(const Scene& scene, std::span<const GlobalMesh> meshes) {
  std::vector<ResolvedProbe> probes;
  for (const Probe& probe : scene.probes) {
    const std::size_t structure = structure_number(scene, probe.structure);
    const GlobalMesh& mesh = meshes[structure];
    const std::vector<SnappedPoint> nodes = probe_nodes(probe, mesh);
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

std::string snap_doubt(const std::string& owner, double distance, double element_size) {
  constexpr double far_snap = 0.2;   // of the largest element at the node
  constexpr double far_place = 0.5;  // m, however large elements are
  if (distance <= std::min(far_snap * element_size, far_place)) return "";
  return sentence(
      "{}: its node is {:.3g} m away from the point asked for, where elements measure {:.3g} m; "
      "give the place of a node, or refine the mesh",
      {owner, distance, element_size});
}

void add_point_groups(const Structure& structure, GlobalMesh& mesh) {
  for (const PointGroup& group : structure.point_groups) {
    const auto refuse = [&](const std::string& why) {
      throw UserError("option -" + group.option + ": " + why);
    };
    if (mesh.groups.contains(group.name)) {
      refuse(structure.mesh + " has a group '" + group.name + "'; choose another name");
    }
    std::vector<GlobalIndex>& nodes = mesh.groups[group.name].nodes;
    SnappedPoint farthest;
    for (const Vector3& point : group.points) {
      const SnappedPoint found = nearest_node(mesh, group.option, structure.name, point);
      if (std::ranges::count(nodes, found.node) > 0) {
        refuse("two of the points have the node at " + place_text(mesh.position(found.node)) +
               " for their nearest; leave one out");
      }
      nodes.push_back(found.node);
      if (found.distance > farthest.distance) farthest = found;
    }
    std::ranges::sort(nodes);
    const std::string doubt =
        snap_doubt("option -" + group.option, farthest.distance, farthest.element_size);
    if (!doubt.empty()) mesh.doubts.push_back(doubt);
    const auto region = std::ranges::find(structure.regions, group.name, &Region::group);
    if (region == structure.regions.end()) {
      mesh.unused.push_back({group.name, "Point", static_cast<GlobalIndex>(nodes.size()), 0,
                             mesh.position(nodes.front())});
      continue;
    }
    const auto number = static_cast<int>(region - structure.regions.begin());
    mesh.regions.push_back(
        {group.name, number, region->element, {}, nodes, {}, has_element_law(*region)});
    for (const GlobalIndex node : nodes) mesh.regions.back().tags.push_back(mesh.node_tags[node]);
  }
}

}  // namespace pounding
