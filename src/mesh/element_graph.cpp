#include "mesh/element_graph.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "elements/element_traits.h"
#include "elements/measured_costs.h"

namespace pounding {
namespace {

/// The two lowest of the parts that have most elements of a node; the same twice if it is one.
std::pair<int, int> leading_parts(std::span<const idx_t> elements, std::span<const idx_t> owner) {
  const auto differs = [&](idx_t e) { return owner[e] != owner[elements.front()]; };
  if (!elements.empty() && std::ranges::none_of(elements, differs)) {
    return {owner[elements.front()], owner[elements.front()]};
  }
  std::map<int, int> counts;
  for (const idx_t element : elements) ++counts[owner[element]];
  std::pair<int, int> leading{-1, -1};
  int most = 0;
  for (const auto& [part, count] : counts) {
    if (count > most) {
      leading = {part, part};
      most = count;
    } else if (count == most && leading.first == leading.second) {
      leading.second = part;
    }
  }
  return leading;
}

}  // namespace

std::vector<idx_t> cut_graph(Graph& graph, std::vector<idx_t>& cost, int parts, long& edge_cut) {
  std::vector<idx_t> owner(cost.size(), 0);
  edge_cut = 0;
  auto vertices = static_cast<idx_t>(cost.size());
  if (vertices <= parts) {
    std::iota(owner.begin(), owner.end(), 0);
    return owner;
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_UFACTOR] = 5;  // thousandths
  idx_t constraints = 1;
  idx_t part_count = parts;
  idx_t cut = 0;
  const auto method = parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = method(&vertices, &constraints, graph.first.data(), graph.neighbours.data(),
                            cost.data(), nullptr, graph.weights.data(), &part_count, nullptr,
                            nullptr, options, &cut, owner.data());
  if (status != METIS_OK) {
    throw std::runtime_error("METIS failed with status " + std::to_string(status));
  }
  edge_cut = cut;
  return owner;
}

int whole_part(std::span<const int> whole, std::size_t structure) {
  return whole.empty() ? -1 : whole[structure];
}

ElementList list_elements(std::span<const GlobalMesh> meshes, std::span<const int> whole) {
  ElementList list;
  list.first.push_back(0);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const GlobalMesh& mesh = meshes[s];
    list.node_offset.push_back(list.node_count);
    list.element_offset.push_back(list.cost.size());
    for (const ElementSet& set : mesh.regions) {
      if (whole_part(whole, s) >= 0) break;
      for (std::size_t e = 0; e < set.tags.size(); ++e) {
        for (const GlobalIndex node : set.nodes_of(e)) list.nodes.push_back(list.node_count + node);
        list.first.push_back(static_cast<idx_t>(list.nodes.size()));
        list.entry.push_back(list.count());
        list.cost.push_back(set.cost());
        list.structure.push_back(static_cast<int>(s));
        list.needed.push_back(shared_by_neighbours(set.type));
      }
    }
    list.node_count += mesh.node_count();
  }
  list.element_offset.push_back(list.cost.size());
  return list;
}

NodeElements elements_at_nodes(const ElementList& list) {
  NodeElements at;
  at.first.assign(static_cast<std::size_t>(list.node_count) + 1, 0);
  for (const GlobalIndex node : list.nodes) ++at.first[node + 1];
  for (std::size_t n = 1; n < at.first.size(); ++n) at.first[n] += at.first[n - 1];
  at.elements.resize(list.nodes.size());
  std::vector<std::size_t> next(at.first.begin(), at.first.end() - 1);
  for (idx_t e = 0; e < list.count(); ++e) {
    for (const GlobalIndex node : list.nodes_of(static_cast<std::size_t>(e))) {
      at.elements[next[node]++] = e;
    }
  }
  return at;
}

Graph dual_graph(const ElementList& list, const NodeElements& at, std::span<const NodeLink> links,
                 std::span<const int> whole) {
  const auto is_whole = [&](int s) { return whole_part(whole, static_cast<std::size_t>(s)) >= 0; };
  std::vector<std::map<idx_t, idx_t>> extra(static_cast<std::size_t>(list.count()));
  for (const NodeLink& link : links) {
    if (is_whole(link.structure_a) || is_whole(link.structure_b)) continue;
    const auto global = [&](int structure, GlobalIndex node) {
      return static_cast<std::size_t>(list.node_offset[structure] + node);
    };
    const idx_t a = at.elements[at.first[global(link.structure_a, link.node_a)]];
    const idx_t b = at.elements[at.first[global(link.structure_b, link.node_b)]];
    if (a != b) {
      extra[a][b] += measured_costs::contact_cut;
      extra[b][a] += measured_costs::contact_cut;
    }
  }
  Graph graph;
  std::vector<idx_t> shared(list.count(), 0);
  std::vector<idx_t> touched;
  for (idx_t e = 0; e < list.count(); ++e) {
    const std::size_t row = e;
    touched.clear();
    for (const GlobalIndex shared_node : list.nodes_of(row)) {
      const std::size_t node = shared_node;
      for (std::size_t j = at.first[node]; j < at.first[node + 1]; ++j) {
        const idx_t other = at.elements[j];
        if (other != e && shared[other]++ == 0) touched.push_back(other);
      }
    }
    std::sort(touched.begin(), touched.end());
    for (const idx_t other : touched) {
      const std::size_t column = other;
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

std::vector<int> node_owners(const NodeElements& at, std::span<const idx_t> owner,
                             std::span<const idx_t> cost, int parts) {
  std::vector<int> nodes(at.first.size() - 1, -1);
  std::map<std::pair<int, int>, std::vector<std::size_t>> tied;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto leading =
        leading_parts({&at.elements[at.first[n]], at.first[n + 1] - at.first[n]}, owner);
    nodes[n] = leading.first;
    if (leading.first != leading.second) tied[leading].push_back(n);
  }
  std::vector<double> held(static_cast<std::size_t>(parts), 0.0);
  for (std::size_t e = 0; e < owner.size(); ++e) held[owner[e]] += static_cast<double>(cost[e]);
  const double cost_of_node =  // of the elements beyond the cut, one for each node
      std::accumulate(held.begin(), held.end(), 0.0) / static_cast<double>(nodes.size());
  std::vector<std::pair<std::pair<int, int>, std::vector<std::size_t>>> cuts(tied.begin(),
                                                                             tied.end());
  std::ranges::stable_sort(
      cuts, [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  for (const auto& [sides, along] : cuts) {
    const int part = held[sides.second] < held[sides.first] ? sides.second : sides.first;
    held[part] += cost_of_node * static_cast<double>(along.size());
    for (const std::size_t n : along) nodes[n] = part;
  }
  return nodes;
}

}  // namespace pounding
