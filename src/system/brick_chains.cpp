#include "system/brick_chains.h"

#include <algorithm>
#include <cstddef>

namespace pounding {
namespace {

/// See BrickChain::ghost_row.
LocalIndex ghost_row(const DofPlaces& places, const std::vector<LocalIndex>& moving) {
  LocalIndex next = -1;
  for (const LocalIndex node : moving) {
    const auto& place = places.of_node[static_cast<std::size_t>(node)];
    const LocalIndex x = place[0];
    const bool follows = x >= places.owned_dofs && place[1] == x + 1 && place[2] == x + 2;
    if (!follows || (next >= 0 && x != next)) return -1;
    next = x + 3;
  }
  return moving.empty() ? -1
                        : next - places.owned_dofs - 3 * static_cast<LocalIndex>(moving.size());
}

}  // namespace

const BrickChain& BrickChains::add(const DofPlaces& places, const std::vector<LocalIndex>& nodes) {
  const auto place_of = [&](LocalIndex node) -> const std::array<LocalIndex, 6>& {
    return places.of_node[static_cast<std::size_t>(node)];
  };
  const auto moves = [&](LocalIndex node) {
    const auto& place = place_of(node);
    return *std::max_element(place.begin(), place.begin() + 3) >= 0;
  };
  const auto first = std::find_if(nodes.begin(), nodes.end(), moves);
  const auto last = std::find_if(nodes.rbegin(), nodes.rend(), moves).base();
  const std::vector<LocalIndex> moving(first, std::max(first, last));
  BrickChain chain;
  chain.begin = static_cast<int>(places_.size());
  chain.length = static_cast<int>(nodes.size());
  chain.first = static_cast<int>(first - nodes.begin());
  chain.moving = static_cast<int>(moving.size());
  chain.plain = true;
  chain.row = !moving.empty();
  LocalIndex end = -1;   // one beyond the last dof of the node before
  LocalIndex next = -1;  // one beyond its last translation
  bool contiguous = !moving.empty();
  for (const LocalIndex node : moving) {
    const auto& [x, y, z, rx, ry, rz] = place_of(node);
    chain.plain = chain.plain && x >= 0 && y == x + 1 && z == x + 2 && z + 1 < places.owned_dofs;
    contiguous = contiguous && chain.plain && (node == moving[0] || x == end);
    chain.row = chain.row && contiguous && (node == moving[0] || x == next);
    if (contiguous) {
      end = places.node_end[static_cast<std::size_t>(node)];
      next = z + 1;
      chain.range = {node == moving[0] ? x : chain.range.begin, end};
    }
  }
  if (!contiguous) chain.range = {};
  if (!chain.plain) chain.ghost_row = ghost_row(places, moving);
  for (const LocalIndex node : chain.plain ? moving : nodes) {
    const auto& place = place_of(node);
    places_.insert(places_.end(), place.begin(), place.begin() + (chain.plain ? 1 : 3));
  }
  return chains_.emplace_back(chain);
}

LocalIndex BrickChains::place(const BrickChain& chain, int node, int component) const {
  const LocalIndex* const from = places(chain);
  if (!chain.plain) return from[3 * node + component];
  const int moving = node - chain.first;
  return moving < 0 || moving >= chain.moving ? -1 : from[moving] + component;
}

}  // namespace pounding
