#include "mesh/node_owners.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

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
