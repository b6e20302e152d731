#include "stiffness/bricks/brick_chains.h"

#include <algorithm>
#include <cstddef>

namespace pounding::stiffness {
namespace {

using Place = std::array<LocalIndex, 6>;

const Place& place_of(const DofPlaces& places, LocalIndex node) {
  return places.of_node[node];
}

/// Dofs x, y, z in a row.
bool in_a_row(const Place& place) {
  return place[0] >= 0 && place[1] == place[0] + 1 && place[2] == place[0] + 2;
}

bool is_owned(const DofPlaces& places, LocalIndex node) {
  const Place& place = place_of(places, node);
  return in_a_row(place) && place[2] < places.owned_dofs;
}

/// The first of the longest stretches of at least half of the nodes in which each node is owned and
/// its dofs follow those of the one before it; else none.
std::span<const LocalIndex> longest_stretch(const DofPlaces& places,
                                            std::span<const LocalIndex> nodes) {
  std::size_t best = 0, best_begin = 0;
  for (std::size_t begin = 0; begin < nodes.size();) {
    std::size_t end = begin;
    while (end < nodes.size() && is_owned(places, nodes[end]) &&
           (end == begin || place_of(places, nodes[end])[0] == places.node_end[nodes[end - 1]])) {
      ++end;
    }
    if (end - begin > best) {
      best = end - begin;
      best_begin = begin;
    }
    begin = std::max(end, begin + 1);
  }
  return 2 * best >= nodes.size() ? nodes.subspan(best_begin, best) : nodes.first(0);
}

void set_core(const DofPlaces& places, std::span<const LocalIndex> nodes, BrickChain& chain) {
  const auto core = longest_stretch(places, nodes);
  if (core.empty()) return;
  chain.first = static_cast<int>(core.data() - nodes.data());
  chain.core = static_cast<int>(core.size());
  chain.range = {place_of(places, core.front())[0], places.node_end[core.back()]};
  chain.row = chain.range.end - chain.range.begin == 3 * chain.core;
}

}  // namespace

const BrickChain& BrickChains::add(const DofPlaces& places, const std::vector<LocalIndex>& nodes) {
  BrickChain chain;
  chain.length = static_cast<int>(nodes.size());
  set_core(places, nodes, chain);
  chain.begin = static_cast<int>(places_.size());
  for (int p = chain.first; p < chain.first + chain.core; ++p) {
    places_.push_back(place_of(places, nodes[p])[0]);
  }
  chain.ends = static_cast<int>(ends_.size());
  for (int p = 0; p < chain.length; ++p) {
    if (chain.in_core(p)) continue;
    const Place& place = place_of(places, nodes[p]);
    ends_.push_back({p, {place[0], place[1], place[2]}});
  }
  return chains_.emplace_back(chain);
}

LocalIndex BrickChains::place(const BrickChain& chain, int node, int component) const {
  if (!chain.in_core(node)) {
    const std::size_t number = node < chain.first ? node : node - chain.core;
    return ends(chain)[number].place[component];
  }
  return places(chain)[node - chain.first] + component;
}

}  // namespace pounding::stiffness
