#include "mesh/rigid_nodes.h"

#include <algorithm>
#include <limits>
#include <map>

#include "common/error.h"
#include "common/integer_sets.h"
#include "mesh/connectivity.h"

namespace pounding {
namespace {

/// Least height between two floors [m].
constexpr double least_storey = 1;

using Cluster = std::vector<GlobalIndex>;

std::string option_text(const Structure& structure, const RigidGroup& rigid) {
  const std::string option = rigid_option(rigid.kind);
  return "option -" + structure.name + option.substr(option.find('_')) + " " + rigid.name();
}

[[noreturn]] void refuse_rigid(const Structure& structure, const RigidGroup& rigid,
                               const std::string& what, const Vector3& x) {
  throw UserError(option_text(structure, rigid) + ": its node at " + place_text(x) + " " + what);
}

/// Sets of two or more nodes, each sorted, in the order of their first nodes.
std::vector<Cluster> clusters_of(DisjointSets& sets, const Cluster& nodes) {
  std::map<std::size_t, Cluster> found;
  for (const GlobalIndex node : nodes) {
    found[sets.root(static_cast<std::size_t>(node))].push_back(node);
  }
  std::vector<Cluster> clusters;
  for (auto& [root, cluster] : found) {
    keep_once(cluster);
    if (cluster.size() > 1) clusters.push_back(std::move(cluster));
  }
  std::ranges::sort(clusters);
  return clusters;
}

std::vector<Cluster> pinned(const GlobalMesh& mesh, const Cluster& nodes) {
  DisjointSets sets(static_cast<std::size_t>(mesh.node_count()));
  const double near = coincidence * bounding_box({&mesh, 1}).diagonal();
  if (!(near > 0)) return {};
  for (const auto& [a, b] : near_nodes(mesh, near)) {
    if (std::ranges::binary_search(nodes, a) && std::ranges::binary_search(nodes, b)) {
      sets.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    }
  }
  return clusters_of(sets, nodes);
}

/// Each of `nodes` with the nearest of `others`, by their x coordinates.
std::vector<Cluster> joined(const GlobalMesh& mesh, const Cluster& nodes, const Cluster& others) {
  const auto x_of = [&](GlobalIndex node) { return mesh.position(node)[0]; };
  Cluster sorted = others;
  std::ranges::stable_sort(sorted, {}, x_of);
  DisjointSets sets(static_cast<std::size_t>(mesh.node_count()));
  Cluster all = nodes;
  for (const GlobalIndex node : nodes) {
    const double x = x_of(node);
    double nearest = std::numeric_limits<double>::infinity();
    GlobalIndex found = -1;
    const auto look = [&](GlobalIndex other) {
      const double apart = distance(mesh.position(node), mesh.position(other));
      if (apart < nearest || (apart == nearest && other < found)) {
        nearest = apart;
        found = other;
      }
    };
    const auto middle = std::ranges::lower_bound(sorted, x, {}, x_of);
    for (auto up = middle; up != sorted.end() && x_of(*up) - x <= nearest; ++up) look(*up);
    for (auto down = middle; down != sorted.begin() && x - x_of(*(down - 1)) <= nearest; --down) {
      look(*(down - 1));
    }
    sets.join(static_cast<std::size_t>(node), static_cast<std::size_t>(found));
    all.push_back(found);
  }
  return clusters_of(sets, all);
}

/// Floors of a group: parted where no node is for `least_storey` in height.
std::vector<Cluster> levels(const Structure& structure, const RigidGroup& rigid,
                            const GlobalMesh& mesh, Cluster nodes) {
  const auto height = [&](GlobalIndex node) { return mesh.position(node)[2]; };
  std::ranges::stable_sort(nodes, {}, height);
  std::vector<Cluster> floors;
  for (const GlobalIndex node : nodes) {
    if (floors.empty() || height(node) - height(floors.back().back()) > least_storey) {
      floors.emplace_back();
    }
    floors.back().push_back(node);
    if (height(node) - height(floors.back().front()) > least_storey) {
      refuse_rigid(structure, rigid,
                   "lies more than 1 m above the lowest of its floor: that is not level",
                   mesh.position(node));
    }
  }
  for (Cluster& floor : floors) std::ranges::sort(floor);
  return floors;
}

/// Nodes of a group by their height.
std::vector<Cluster> heights(const GlobalMesh& mesh, const Cluster& nodes) {
  const auto height = [&](GlobalIndex node) { return mesh.position(node)[2]; };
  const double near = coincidence * bounding_box({&mesh, 1}).diagonal();
  Cluster sorted = nodes;
  std::ranges::stable_sort(sorted, {}, height);
  std::vector<Cluster> found;
  for (const GlobalIndex node : sorted) {
    if (found.empty() || height(node) - height(found.back().back()) > near) found.emplace_back();
    found.back().push_back(node);
  }
  std::erase_if(found, [](const Cluster& cluster) { return cluster.size() < 2; });
  for (Cluster& cluster : found) std::ranges::sort(cluster);
  return found;
}

bool is_held(const GlobalMesh& mesh, const Cluster& cluster) {
  return std::ranges::all_of(cluster,
                             [&](GlobalIndex node) { return mesh.free_components[node] == 0; });
}

/// Components that are clamped at every node of a level, or of a floor that cannot turn about z, as
/// that of a plane frame: nothing follows in them, and no rotation couples them to the others.
unsigned left_out(const GlobalMesh& mesh, const RigidGroup& rigid, const Cluster& cluster) {
  constexpr unsigned about_z = 0x20;
  if (rigid.kind != RigidKind::level && rigid.kind != RigidKind::diaphragm) return 0;
  unsigned common = rigid.components();
  for (const GlobalIndex node : cluster) common &= mesh.clamped(node);
  const bool turns = rigid.kind == RigidKind::diaphragm && (common & about_z) == 0;
  return turns ? 0 : common;
}

/// Components in which nodes of a body follow it, node by node; none where they follow in all.
std::vector<std::uint8_t> rows_of(const RigidGroup& rigid, const GlobalMesh& mesh,
                                  const Cluster& cluster) {
  if (rigid.kind != RigidKind::body || rigid.following == 0x3f) return {};
  std::vector<std::uint8_t> rows;
  for (const GlobalIndex node : cluster) {
    const bool whole =
        !rigid.other.empty() && std::ranges::binary_search(mesh.groups.at(rigid.group).nodes, node);
    rows.push_back(whole ? 0x3f : rigid.following);
  }
  return rows;
}

/// Whether one of the bodies found holds all of a cluster.
bool is_in_body(const std::vector<RigidNodes>& found, const Cluster& cluster) {
  return std::ranges::any_of(found, [&](const RigidNodes& body) {
    return body.kind == RigidKind::body && std::ranges::includes(body.nodes, cluster);
  });
}

std::vector<Cluster> clusters_of(const Structure& structure, const RigidGroup& rigid,
                                 const GlobalMesh& mesh) {
  Cluster nodes = mesh.groups.at(rigid.group).nodes;
  switch (rigid.kind) {
    case RigidKind::join:
      return joined(mesh, nodes, mesh.groups.at(rigid.other).nodes);
    case RigidKind::diaphragm:
      return levels(structure, rigid, mesh, nodes);
    case RigidKind::pin:
      return pinned(mesh, nodes);
    case RigidKind::level:
      return heights(mesh, nodes);
    default:
      if (!rigid.other.empty()) {
        const Cluster& more = mesh.groups.at(rigid.other).nodes;
        nodes.insert(nodes.end(), more.begin(), more.end());
        keep_once(nodes);
      }
      return {nodes};
  }
}

}  // namespace

std::vector<RigidNodes> find_rigid_nodes(const Structure& structure, const GlobalMesh& mesh) {
  std::vector<RigidNodes> found;
  std::map<GlobalIndex, std::string> group_of;
  for (const RigidGroup& rigid : structure.rigid_groups) {
    if (rigid.kind == RigidKind::tie) continue;
    const std::vector<Cluster> clusters = clusters_of(structure, rigid, mesh);
    refuse_if(clusters.empty(),
              option_text(structure, rigid) + ": no two nodes of it lie " +
                  (rigid.kind == RigidKind::pin ? "on each other" : "at one height"));
    for (const Cluster& cluster : clusters) {
      if (is_held(mesh, cluster)) continue;  // clamped altogether: nothing follows anything
      if (rigid.implied && (cluster.size() == 1 || is_in_body(found, cluster))) continue;
      const unsigned following = rigid.components() & ~left_out(mesh, rigid, cluster);
      if (following == 0) continue;
      found.push_back({rigid.name(),
                       rigid.kind,
                       static_cast<std::uint8_t>(following),
                       cluster,
                       rows_of(rigid, mesh, cluster),
                       {}});
      for (std::size_t k = 0; k < cluster.size(); ++k) {
        const GlobalIndex node = cluster[k];
        const std::vector<std::uint8_t>& rows = found.back().rows;
        const auto [other, is_new] = group_of.try_emplace(node, rigid.name());
        if (!is_new) {
          refuse_rigid(
              structure, rigid,
              "is in " + other->second + " as well; make them one group, or keep them apart",
              mesh.position(node));
        }
        if ((mesh.clamped(node) & (rows.empty() ? following : rows[k])) != 0) {
          refuse_rigid(structure, rigid,
                       "is clamped; clamp all that moves with it instead, or none of it",
                       mesh.position(node));
        }
      }
    }
  }
  return found;
}

}  // namespace pounding
