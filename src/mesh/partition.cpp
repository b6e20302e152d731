#include "mesh/partition.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>

#include "elements/measured_costs.h"
#include "mesh/element_graph.h"
#include "mesh/element_groups.h"

namespace pounding {
namespace {

std::size_t element_count(const GlobalMesh& mesh) {
  std::size_t count = 0;
  for (const ElementSet& set : mesh.regions) count += set.tags.size();
  return count;
}

/// So many pieces make a part of an even cut.
constexpr idx_t pieces_per_part = 64;

/// Keeps a row of elements in one part: rows are cheapest whole.
idx_t most_piece_cost(const ElementList& list, int parts) {
  const auto total = std::accumulate(list.cost.begin(), list.cost.end(), std::int64_t{0});
  return static_cast<idx_t>(total / (std::int64_t{pieces_per_part} * parts));
}

/// Cost of the elements of the most loaded part.
double largest_cost(const ElementList& list, const std::vector<idx_t>& owner, int parts) {
  std::vector<double> cost(parts, 0);
  for (std::size_t e = 0; e < owner.size(); ++e) cost[owner[e]] += list.cost[e];
  return *std::max_element(cost.begin(), cost.end());
}

double imbalance_of(const ElementList& list, const std::vector<idx_t>& owner, int parts) {
  const double total = std::accumulate(list.cost.begin(), list.cost.end(), 0.0);
  return total > 0 ? largest_cost(list, owner, parts) * parts / total : 1;
}

/// Every structure to one part, the costliest first, each to the part with the least so far.
std::vector<idx_t> keep_structures(const ElementList& list, std::size_t structures, int parts) {
  std::vector<double> cost(structures, 0.0);
  for (std::size_t e = 0; e < list.cost.size(); ++e) cost[list.structure[e]] += list.cost[e];
  std::vector<std::size_t> order(structures);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cost[a] > cost[b]; });
  std::vector<double> load(parts, 0.0);
  std::vector<idx_t> part(structures, 0);
  for (const std::size_t s : order) {
    const auto lightest = std::min_element(load.begin(), load.end());
    part[s] = static_cast<idx_t>(lightest - load.begin());
    *lightest += cost[s];
  }
  std::vector<idx_t> owner;
  for (const int s : list.structure) owner.push_back(part[s]);
  return owner;
}

bool structures_are_cheaper(const ElementList& list, const std::vector<idx_t>& cut,
                            const std::vector<idx_t>& kept, int parts) {
  std::map<int, std::set<idx_t>> owners;
  for (std::size_t e = 0; e < cut.size(); ++e) owners[list.structure[e]].insert(cut[e]);
  const auto shared = std::ranges::count_if(
      owners, [](const auto& structure) { return structure.second.size() > 1; });
  return largest_cost(list, kept, parts) <=
         largest_cost(list, cut, parts) + measured_costs::sharing * static_cast<double>(shared);
}

/// One owner for the nodes of a cluster: that of most of them, the lowest on a tie.
void unite(const NodeCluster& cluster, std::vector<int>& node_owner) {
  std::map<int, int> counts;
  for (const GlobalIndex node : cluster.nodes) ++counts[node_owner[node]];
  const auto owner =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const GlobalIndex node : cluster.nodes) node_owner[node] = owner->first;
}

}  // namespace

Partition partition_meshes(std::span<const GlobalMesh> meshes, std::span<const NodeLink> links,
                           int parts, std::span<const int> whole,
                           std::span<const NodeCluster> clusters, PartitionBy by) {
  const bool cuts = by != PartitionBy::structures && parts > 1;
  ElementList list = list_elements(meshes, whole);
  ElementGroups groups = cuts ? group_rows(meshes, list, most_piece_cost(list, parts))
                              : ElementGroups{std::vector<int>(list.cost.size(), -1)};
  group_clusters(list, clusters, groups);
  if (groups.count > 0) list = merge_groups(list, groups);
  const NodeElements at = elements_at_nodes(list);
  Partition partition;
  partition.parts = parts;
  std::vector<idx_t> owner = keep_structures(list, meshes.size(), parts);
  if (cuts) {
    Graph graph = dual_graph(list, at, links, whole);
    long edge_cut = 0;
    std::vector<idx_t> cut = cut_graph(graph, list.cost, parts, edge_cut);
    if (by == PartitionBy::elements || !structures_are_cheaper(list, cut, owner, parts)) {
      owner = std::move(cut);
      partition.edge_cut = edge_cut;
    }
  }
  partition.imbalance = imbalance_of(list, owner, parts);
  const std::vector<int> of_nodes = node_owners(at, owner, list.cost, parts);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    if (const int part = whole_part(whole, s); part >= 0) {
      partition.element_owner.emplace_back(element_count(meshes[s]), part);
      partition.node_owner.emplace_back(static_cast<std::size_t>(meshes[s].node_count()), part);
      continue;
    }
    std::vector<int>& owners = partition.element_owner.emplace_back();
    for (std::size_t e = list.element_offset[s]; e < list.element_offset[s + 1]; ++e) {
      owners.push_back(owner[list.entry[e]]);
    }
    const auto first = of_nodes.begin() + list.node_offset[s];
    partition.node_owner.emplace_back(first,
                                      first + static_cast<std::ptrdiff_t>(meshes[s].node_count()));
  }
  for (const NodeCluster& cluster : clusters) {
    unite(cluster, partition.node_owner[cluster.structure]);
  }
  return partition;
}

}  // namespace pounding
