#include "mesh/partition.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <metis.h>

#include "elements/element.h"

namespace pounding {
namespace {

/// Every element of every structure in one list, with global node numbers that run on from
/// structure to structure. What METIS must not cut is one entry: the elements inside a cluster.
struct ElementList {
  std::vector<idx_t> first;  ///< CSR offsets into nodes
  std::vector<GlobalIndex> nodes;
  std::vector<idx_t> cost;
  std::vector<int> needed;  ///< shared nodes that make two elements neighbours
  std::vector<GlobalIndex> node_offset;
  std::vector<std::size_t> element_offset;
  std::vector<idx_t> entry;  ///< of each element
  GlobalIndex node_count = 0;
  idx_t count() const { return static_cast<idx_t>(cost.size()); }
};

/// Relative cost of one element in a step, its share of the nodes included, as measured on slabs
/// and frames: about nanoseconds.
idx_t element_cost(ElementType type) {
  switch (type) {
    case ElementType::hex8:
    case ElementType::hex8_full:
      return 18;
    case ElementType::shell4:
      return 20;
    case ElementType::shell3:  // in a sparse matrix
      return 100;
    case ElementType::beam:
      return 14;
    default:
      return 2;
  }
}

/// Part that gets all of a structure; -1: it is cut.
int whole_part(std::span<const int> whole, std::size_t structure) {
  return whole.empty() ? -1 : whole[structure];
}

/// The elements of the structures that are cut.
ElementList list_elements(std::span<const GlobalMesh> meshes, std::span<const int> whole) {
  ElementList list;
  list.first.push_back(0);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const GlobalMesh& mesh = meshes[s];
    list.node_offset.push_back(list.node_count);
    list.element_offset.push_back(list.cost.size());
    for (const ElementSet& set : mesh.regions) {
      if (whole_part(whole, s) >= 0) {
        break;
      }
      const auto width = static_cast<std::size_t>(element_layout(set.type).nodes);
      for (std::size_t e = 0; e < set.tags.size(); ++e) {
        for (std::size_t a = 0; a < width; ++a) {
          list.nodes.push_back(list.node_count + set.connectivity[e * width + a]);
        }
        list.first.push_back(static_cast<idx_t>(list.nodes.size()));
        list.entry.push_back(list.count());
        list.cost.push_back(element_cost(set.type));
        list.needed.push_back(width == 8 ? 4 : 1);
      }
    }
    list.node_count += mesh.node_count();
  }
  list.element_offset.push_back(list.cost.size());
  return list;
}

/// Cost of a node of a cluster: its part in a solution instead of a division.
constexpr idx_t cluster_node_cost = 36;

/// The cluster of each node, -1: none.
std::vector<int> cluster_of_nodes(const ElementList& list, std::span<const NodeCluster> clusters) {
  std::vector<int> cluster(static_cast<std::size_t>(list.node_count), -1);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const GlobalIndex offset = list.node_offset[static_cast<std::size_t>(clusters[c].structure)];
    for (const GlobalIndex node : clusters[c].nodes) {
      cluster[static_cast<std::size_t>(offset + node)] = static_cast<int>(c);
    }
  }
  return cluster;
}

/// The cluster that holds every node of a small element, -1: none.
int cluster_of_element(std::span<const GlobalIndex> nodes, const std::vector<int>& cluster) {
  const auto of = [&](GlobalIndex node) { return cluster[static_cast<std::size_t>(node)]; };
  const bool inside = nodes.size() <= 2 && of(nodes.front()) == of(nodes.back());
  return inside ? of(nodes.front()) : -1;
}

/// Puts the elements inside each cluster together, behind all others.
ElementList merge_clusters(const ElementList& all, std::span<const NodeCluster> clusters) {
  const std::vector<int> cluster = cluster_of_nodes(all, clusters);
  ElementList list;
  list.first.push_back(0);
  list.node_offset = all.node_offset;
  list.element_offset = all.element_offset;
  list.node_count = all.node_count;
  list.entry.resize(all.cost.size());
  std::vector<std::vector<std::size_t>> inside(clusters.size());
  const auto nodes_of = [&](std::size_t e) {
    return std::span<const GlobalIndex>(all.nodes).subspan(
        static_cast<std::size_t>(all.first[e]),
        static_cast<std::size_t>(all.first[e + 1] - all.first[e]));
  };
  const auto add = [&](const auto& nodes, idx_t cost, int needed) {
    list.nodes.insert(list.nodes.end(), nodes.begin(), nodes.end());
    list.first.push_back(static_cast<idx_t>(list.nodes.size()));
    list.cost.push_back(cost);
    list.needed.push_back(needed);
  };
  for (std::size_t e = 0; e < all.cost.size(); ++e) {
    if (const int c = cluster_of_element(nodes_of(e), cluster); c >= 0) {
      inside[static_cast<std::size_t>(c)].push_back(e);
      continue;
    }
    list.entry[e] = list.count();
    add(nodes_of(e), all.cost[e], all.needed[e]);
  }
  for (const std::vector<std::size_t>& elements : inside) {
    std::set<GlobalIndex> nodes;
    idx_t cost = 0;
    for (const std::size_t e : elements) {
      list.entry[e] = list.count();
      nodes.insert(nodes_of(e).begin(), nodes_of(e).end());
      cost += all.cost[e];
    }
    if (!nodes.empty()) {
      add(nodes, cost + cluster_node_cost * static_cast<idx_t>(nodes.size()), 1);
    }
  }
  return list;
}

std::size_t element_count(const GlobalMesh& mesh) {
  std::size_t count = 0;
  for (const ElementSet& set : mesh.regions) {
    count += set.tags.size();
  }
  return count;
}

/// Elements at each node, CSR.
struct NodeElements {
  std::vector<std::size_t> first;
  std::vector<idx_t> elements;
};

NodeElements elements_at_nodes(const ElementList& list) {
  NodeElements at;
  at.first.assign(static_cast<std::size_t>(list.node_count) + 1, 0);
  for (const GlobalIndex node : list.nodes) {
    ++at.first[static_cast<std::size_t>(node) + 1];
  }
  for (std::size_t n = 1; n < at.first.size(); ++n) {
    at.first[n] += at.first[n - 1];
  }
  at.elements.resize(list.nodes.size());
  std::vector<std::size_t> next(at.first.begin(), at.first.end() - 1);
  for (idx_t e = 0; e < list.count(); ++e) {
    for (auto k = static_cast<std::size_t>(list.first[static_cast<std::size_t>(e)]);
         k < static_cast<std::size_t>(list.first[static_cast<std::size_t>(e) + 1]); ++k) {
      at.elements[next[static_cast<std::size_t>(list.nodes[k])]++] = e;
    }
  }
  return at;
}

struct Graph {
  std::vector<idx_t> first{0};
  std::vector<idx_t> neighbours;
  std::vector<idx_t> weights;
};

/// Cutting a contact costs a message in every step: many times a cut between two elements.
constexpr idx_t link_weight = 64;

Graph dual_graph(const ElementList& list, const NodeElements& at, std::span<const NodeLink> links,
                 std::span<const int> whole) {
  const auto is_whole = [&](int s) { return whole_part(whole, static_cast<std::size_t>(s)) >= 0; };
  std::vector<std::map<idx_t, idx_t>> extra(static_cast<std::size_t>(list.count()));
  for (const NodeLink& link : links) {
    if (is_whole(link.structure_a) || is_whole(link.structure_b)) {
      continue;
    }
    const auto global = [&](int structure, GlobalIndex node) {
      return static_cast<std::size_t>(list.node_offset[static_cast<std::size_t>(structure)] + node);
    };
    const idx_t a = at.elements[at.first[global(link.structure_a, link.node_a)]];
    const idx_t b = at.elements[at.first[global(link.structure_b, link.node_b)]];
    if (a != b) {
      extra[static_cast<std::size_t>(a)][b] += link_weight;
      extra[static_cast<std::size_t>(b)][a] += link_weight;
    }
  }
  Graph graph;
  std::vector<idx_t> shared(static_cast<std::size_t>(list.count()), 0);
  std::vector<idx_t> touched;
  for (idx_t e = 0; e < list.count(); ++e) {
    const auto row = static_cast<std::size_t>(e);
    touched.clear();
    for (auto k = static_cast<std::size_t>(list.first[row]);
         k < static_cast<std::size_t>(list.first[row + 1]); ++k) {
      const auto node = static_cast<std::size_t>(list.nodes[k]);
      for (std::size_t j = at.first[node]; j < at.first[node + 1]; ++j) {
        const idx_t other = at.elements[j];
        if (other != e && shared[static_cast<std::size_t>(other)]++ == 0) {
          touched.push_back(other);
        }
      }
    }
    std::sort(touched.begin(), touched.end());
    for (const idx_t other : touched) {
      const auto column = static_cast<std::size_t>(other);
      if (shared[column] >= std::min(list.needed[row], list.needed[column])) {
        graph.neighbours.push_back(other);
        graph.weights.push_back(shared[column]);
      }
      shared[column] = 0;
    }
    for (const auto& [other, weight] : extra[row]) {
      graph.neighbours.push_back(other);
      graph.weights.push_back(weight);
    }
    graph.first.push_back(static_cast<idx_t>(graph.neighbours.size()));
  }
  return graph;
}

std::vector<idx_t> cut_graph(ElementList& list, Graph& graph, int parts, long& edge_cut) {
  std::vector<idx_t> owner(list.cost.size(), 0);
  edge_cut = 0;
  if (parts == 1) {
    return owner;
  }
  if (list.count() <= parts) {
    for (std::size_t e = 0; e < owner.size(); ++e) {
      owner[e] = static_cast<idx_t>(e);
    }
    return owner;
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_UFACTOR] = 20;
  idx_t vertices = list.count();
  idx_t constraints = 1;
  idx_t part_count = parts;
  idx_t cut = 0;
  const auto method = parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = method(&vertices, &constraints, graph.first.data(), graph.neighbours.data(),
                            list.cost.data(), nullptr, graph.weights.data(), &part_count, nullptr,
                            nullptr, options, &cut, owner.data());
  if (status != METIS_OK) {
    throw std::runtime_error("METIS failed with status " + std::to_string(status));
  }
  edge_cut = cut;
  return owner;
}

double imbalance_of(const ElementList& list, const std::vector<idx_t>& owner, int parts) {
  std::vector<double> cost(static_cast<std::size_t>(parts), 0);
  double total = 0;
  for (std::size_t e = 0; e < owner.size(); ++e) {
    cost[static_cast<std::size_t>(owner[e])] += list.cost[e];
    total += list.cost[e];
  }
  return total > 0 ? *std::max_element(cost.begin(), cost.end()) * parts / total : 1;
}

/// One owner for the nodes of a cluster: that of most of them, the lowest on a tie.
void unite(const NodeCluster& cluster, std::vector<int>& node_owner) {
  std::map<int, int> counts;
  for (const GlobalIndex node : cluster.nodes) {
    ++counts[node_owner[static_cast<std::size_t>(node)]];
  }
  const auto owner =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const GlobalIndex node : cluster.nodes) {
    node_owner[static_cast<std::size_t>(node)] = owner->first;
  }
}

int most_frequent_owner(std::span<const idx_t> elements, const std::vector<idx_t>& owner) {
  int best = -1;
  int best_count = 0;
  for (const idx_t candidate : elements) {
    const idx_t part = owner[static_cast<std::size_t>(candidate)];
    const int count =
        static_cast<int>(std::count_if(elements.begin(), elements.end(), [&](idx_t e) {
          return owner[static_cast<std::size_t>(e)] == part;
        }));
    if (count > best_count || (count == best_count && part < best)) {
      best = part;
      best_count = count;
    }
  }
  return best;
}

}  // namespace

Partition partition_meshes(std::span<const GlobalMesh> meshes, std::span<const NodeLink> links,
                           int parts, std::span<const int> whole,
                           std::span<const NodeCluster> clusters) {
  ElementList list = list_elements(meshes, whole);
  if (!clusters.empty()) {
    list = merge_clusters(list, clusters);
  }
  const NodeElements at = elements_at_nodes(list);
  Graph graph;
  if (parts > 1) {
    graph = dual_graph(list, at, links, whole);
  }
  Partition partition;
  partition.parts = parts;
  const std::vector<idx_t> owner = cut_graph(list, graph, parts, partition.edge_cut);
  partition.imbalance = imbalance_of(list, owner, parts);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    if (const int part = whole_part(whole, s); part >= 0) {
      partition.element_owner.emplace_back(element_count(meshes[s]), part);
      partition.node_owner.emplace_back(static_cast<std::size_t>(meshes[s].node_count()), part);
      continue;
    }
    std::vector<int>& elements = partition.element_owner.emplace_back();
    for (std::size_t e = list.element_offset[s]; e < list.element_offset[s + 1]; ++e) {
      elements.push_back(owner[static_cast<std::size_t>(list.entry[e])]);
    }
    std::vector<int> nodes(static_cast<std::size_t>(meshes[s].node_count()));
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::size_t g = static_cast<std::size_t>(list.node_offset[s]) + n;
      nodes[n] =
          most_frequent_owner({&at.elements[at.first[g]], at.first[g + 1] - at.first[g]}, owner);
    }
    partition.node_owner.push_back(std::move(nodes));
  }
  for (const NodeCluster& cluster : clusters) {
    unite(cluster, partition.node_owner[static_cast<std::size_t>(cluster.structure)]);
  }
  return partition;
}

}  // namespace pounding
