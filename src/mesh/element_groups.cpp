#include "mesh/element_groups.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "common/integer_sets.h"
#include "elements/measured_costs.h"

namespace pounding {
namespace {

/// A longer run of elements is no faster.
constexpr idx_t longest_piece = 64;

using GridPlace = std::array<std::int64_t, 3>;

/// Place of an element of a row.
struct RowPlace {
  std::array<std::int64_t, 4> across{};  ///< first and last layer, first and last row
  idx_t cost = 0;
  std::int64_t begin = 0;  ///< along the row
  std::int64_t end = 0;
  std::size_t element = 0;

  bool operator<(const RowPlace& other) const {
    return std::tie(across, cost, begin, end, element) <
           std::tie(other.across, other.cost, other.begin, other.end, other.element);
  }
  bool continued_by(const RowPlace& other) const {
    return across == other.across && cost == other.cost && end == other.begin;
  }
};

/// `places` of the nodes of the structure, whose first node has the number `offset` in the list.
RowPlace row_place(const ElementList& list, std::size_t e, const std::vector<GridPlace>& places,
                   GlobalIndex offset) {
  const auto nodes = list.nodes_of(e);
  GridPlace low = places[nodes.front() - offset];
  GridPlace high = low;
  for (const GlobalIndex node : nodes) {
    const GridPlace& place = places[node - offset];
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], place[d]);
      high[d] = std::max(high[d], place[d]);
    }
  }
  return {{low[0], high[0], low[1], high[1]}, list.cost[e], low[2], high[2], e};
}

/// Elements in rows of one structure, row after row.
std::vector<RowPlace> sorted_rows(const GlobalMesh& mesh, const ElementList& list, std::size_t s) {
  const NodePlanes planes(mesh);
  std::vector<GridPlace> places;
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    places.push_back(planes.place(mesh.position(node)));
  }
  std::vector<RowPlace> rows;
  std::size_t e = list.element_offset[s];
  for (const ElementSet& set : mesh.regions) {
    for (std::size_t i = 0; i < set.tags.size(); ++i, ++e) {
      if (has_shape(set.type)) rows.push_back(row_place(list, e, places, list.node_offset[s]));
    }
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// The cluster of each node, -1: none.
std::vector<int> cluster_of_nodes(const ElementList& list, std::span<const NodeCluster> clusters) {
  std::vector<int> cluster(list.node_count, -1);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const GlobalIndex offset = list.node_offset[clusters[c].structure];
    for (const GlobalIndex node : clusters[c].nodes) cluster[offset + node] = static_cast<int>(c);
  }
  return cluster;
}

/// The cluster that holds every node of a small element, -1: none.
int cluster_of_element(std::span<const GlobalIndex> nodes, const std::vector<int>& cluster) {
  const auto of = [&](GlobalIndex node) { return cluster[node]; };
  const bool inside = nodes.size() <= 2 && of(nodes.front()) == of(nodes.back());
  return inside ? of(nodes.front()) : -1;
}

/// Coordinates closer than this part of the longest extent lie in one plane.
constexpr double same_plane = 1e-7;

}  // namespace

ElementGroups group_rows(std::span<const GlobalMesh> meshes, const ElementList& list,
                         idx_t most_cost) {
  ElementGroups groups;
  groups.of.assign(list.cost.size(), -1);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    if (list.element_offset[s] == list.element_offset[s + 1]) continue;
    const std::vector<RowPlace> rows = sorted_rows(meshes[s], list, s);
    for (std::size_t begin = 0; begin < rows.size();) {
      std::size_t end = begin + 1;
      while (end < rows.size() && rows[end - 1].continued_by(rows[end])) ++end;
      const std::size_t length = end - begin;
      const std::size_t most = std::clamp(most_cost / rows[begin].cost, idx_t{1}, longest_piece);
      const std::size_t pieces = (length + most - 1) / most;
      for (std::size_t i = 0; i < length && pieces < length; ++i) {
        groups.of[rows[begin + i].element] = groups.count + static_cast<int>(i * pieces / length);
      }
      groups.count += pieces < length ? static_cast<int>(pieces) : 0;
      begin = end;
    }
  }
  groups.first_cluster = groups.count;
  return groups;
}

void group_clusters(const ElementList& list, std::span<const NodeCluster> clusters,
                    ElementGroups& groups) {
  if (clusters.empty()) return;
  const std::vector<int> cluster = cluster_of_nodes(list, clusters);
  for (std::size_t e = 0; e < list.cost.size(); ++e) {
    if (const int c = cluster_of_element(list.nodes_of(e), cluster); c >= 0) {
      groups.of[e] = groups.first_cluster + c;
    }
  }
  groups.count = groups.first_cluster + static_cast<int>(clusters.size());
}

ElementList merge_groups(const ElementList& all, const ElementGroups& groups) {
  ElementList list;
  list.first.push_back(0);
  list.node_offset = all.node_offset;
  list.element_offset = all.element_offset;
  list.node_count = all.node_count;
  list.entry.resize(all.cost.size());
  const auto add = [&](const auto& nodes, idx_t cost, int structure, int needed) {
    list.nodes.insert(list.nodes.end(), nodes.begin(), nodes.end());
    list.first.push_back(static_cast<idx_t>(list.nodes.size()));
    list.cost.push_back(cost);
    list.structure.push_back(structure);
    list.needed.push_back(needed);
  };
  std::vector<std::vector<std::size_t>> members(groups.count);
  for (std::size_t e = 0; e < all.cost.size(); ++e) {
    if (groups.of[e] >= 0) {
      members[groups.of[e]].push_back(e);
      continue;
    }
    list.entry[e] = list.count();
    add(all.nodes_of(e), all.cost[e], all.structure[e], all.needed[e]);
  }
  for (std::size_t g = 0; g < members.size(); ++g) {
    if (members[g].empty()) continue;
    std::vector<GlobalIndex> nodes;
    idx_t cost = 0;
    for (const std::size_t e : members[g]) {
      list.entry[e] = list.count();
      nodes.insert(nodes.end(), all.nodes_of(e).begin(), all.nodes_of(e).end());
      cost += all.cost[e];
    }
    keep_once(nodes);
    const std::size_t first = members[g].front();
    const bool is_cluster = static_cast<int>(g) >= groups.first_cluster;
    const idx_t solution =
        is_cluster ? measured_costs::cluster_node * static_cast<idx_t>(nodes.size()) : 0;
    add(nodes, cost + solution, all.structure[first], is_cluster ? 1 : all.needed[first]);
  }
  return list;
}

NodePlanes::NodePlanes(const GlobalMesh& mesh) {
  const BoundingBox box = bounding_box({&mesh, 1});
  const auto extent = [&](std::size_t d) { return box.high[d] - box.low[d]; };
  std::stable_sort(axes_.begin(), axes_.end(),
                   [&](std::size_t a, std::size_t b) { return extent(a) > extent(b); });
  std::swap(axes_[1], axes_[2]);
  low_ = box.low;
  spacing_ = same_plane * extent(axes_[0]);
}

std::array<std::int64_t, 3> NodePlanes::place(const Vector3& x) const {
  std::array<std::int64_t, 3> place{};
  for (std::size_t d = 0; d < 3 && spacing_ > 0; ++d) {
    place[d] = std::llround((x[axes_[d]] - low_[axes_[d]]) / spacing_);
  }
  return place;
}

}  // namespace pounding
