#include "stiffness/bricks/brick_chains.h"

#include <algorithm>
#include <cstddef>

namespace pounding {
namespace {

using Place = std::array<LocalIndex, 6>;

const Place& place_of(const DofPlaces& places, LocalIndex node) {
  return places.of_node[node];
}

/// Dofs x, y, z in a row.
bool in_a_row(const Place& place) {
  return place[0] >= 0 && place[1] == place[0] + 1 && place[2] == place[0] + 2;
}

/// Owned ones, and not the very last: one more may be read.
bool is_plain(const DofPlaces& places, LocalIndex node) {
  const Place& place = place_of(places, node);
  return in_a_row(place) && place[2] + 1 < places.owned_dofs;
}

/// The first of the longest stretches of at least half of the nodes in which each node follows
/// the one before it; else none.
template <typename Alone, typename Follows>
std::span<const LocalIndex> longest_stretch(std::span<const LocalIndex> nodes, Alone&& alone,
                                            Follows&& follows) {
  std::size_t best = 0, best_begin = 0;
  for (std::size_t begin = 0; begin < nodes.size();) {
    std::size_t end = begin;
    while (end < nodes.size() && alone(nodes[end]) &&
           (end == begin || follows(nodes[end - 1], nodes[end]))) {
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

/// The longest stretch of owned nodes, else of ghosts, else all that moves if it is plain.
void set_core(const DofPlaces& places, std::span<const LocalIndex> nodes, BrickChain& chain) {
  const auto x_of = [&](LocalIndex node) { return place_of(places, node)[0]; };
  const auto take = [&](std::span<const LocalIndex> core) {
    chain.first = static_cast<int>(core.data() - nodes.data());
    chain.core = static_cast<int>(core.size());
    return !core.empty();
  };
  const auto plain = [&](LocalIndex node) { return is_plain(places, node); };
  const auto end_of = [&](LocalIndex node) { return places.node_end[node]; };
  const auto owned = longest_stretch(nodes, plain, [&](LocalIndex before, LocalIndex node) {
    return x_of(node) == end_of(before);
  });
  if (take(owned)) {
    chain.plain = true;
    chain.range = {x_of(owned.front()), end_of(owned.back())};
    chain.row = chain.range.end - chain.range.begin == 3 * chain.core;
    return;
  }
  const auto ghosts = longest_stretch(
      nodes,
      [&](LocalIndex node) {
        return in_a_row(place_of(places, node)) && x_of(node) >= places.owned_dofs;
      },
      [&](LocalIndex before, LocalIndex node) { return x_of(node) == x_of(before) + 3; });
  if (take(ghosts)) {
    chain.first_ghost = x_of(ghosts.front());
    return;
  }
  const auto moves = [&](LocalIndex node) {
    const Place& place = place_of(places, node);
    return *std::max_element(place.begin(), place.begin() + 3) >= 0;
  };
  const auto first = std::find_if(nodes.begin(), nodes.end(), moves);
  const auto last = std::find_if(nodes.rbegin(), nodes.rend(), moves).base();
  chain.plain = first < last && std::all_of(first, last, plain);
  if (chain.plain) take({first, last});
}

}  // namespace

const BrickChain& BrickChains::add(const DofPlaces& places, const std::vector<LocalIndex>& nodes) {
  BrickChain chain;
  chain.length = static_cast<int>(nodes.size());
  set_core(places, nodes, chain);
  chain.begin = static_cast<int>(places_.size());
  for (int p = chain.first; chain.plain && p < chain.first + chain.core; ++p) {
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
  const int in_core = node - chain.first;
  if (!chain.plain) return chain.first_ghost + 3 * in_core + component;
  return places(chain)[in_core] + component;
}

}  // namespace pounding
