#include "stiffness/bricks/brick_chains.h"

#include <algorithm>
#include <cstddef>

namespace pounding::stiffness {
namespace {

using Slot = std::array<LocalIndex, 6>;

const Slot& slots_of(const DofSlots& slots, LocalIndex node) {
  return slots.of_node[node];
}

/// Dofs x, y, z in a row.
bool in_a_row(const Slot& slot) {
  return slot[0] >= 0 && slot[1] == slot[0] + 1 && slot[2] == slot[0] + 2;
}

bool is_owned(const DofSlots& slots, LocalIndex node) {
  const Slot& slot = slots_of(slots, node);
  return in_a_row(slot) && slot[2] < slots.owned_dofs;
}

/// The first of the longest stretches of at least half of the nodes in which each node is owned and
/// its dofs follow those of the one before it; else none.
std::span<const LocalIndex> longest_stretch(const DofSlots& slots,
                                            std::span<const LocalIndex> nodes) {
  std::size_t best = 0, best_begin = 0;
  for (std::size_t begin = 0; begin < nodes.size();) {
    std::size_t end = begin;
    while (end < nodes.size() && is_owned(slots, nodes[end]) &&
           (end == begin || slots_of(slots, nodes[end])[0] == slots.node_end[nodes[end - 1]])) {
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

void set_core(const DofSlots& slots, std::span<const LocalIndex> nodes, BrickChain& chain) {
  const auto core = longest_stretch(slots, nodes);
  if (core.empty()) return;
  chain.first = static_cast<int>(core.data() - nodes.data());
  chain.core = static_cast<int>(core.size());
  chain.range = {slots_of(slots, core.front())[0], slots.node_end[core.back()]};
  chain.row = chain.range.end - chain.range.begin == 3 * chain.core;
}

}  // namespace

const BrickChain& BrickChains::add(const DofSlots& slots, const std::vector<LocalIndex>& nodes) {
  BrickChain chain;
  chain.length = static_cast<int>(nodes.size());
  set_core(slots, nodes, chain);
  chain.begin = static_cast<int>(slots_.size());
  for (int p = chain.first; p < chain.first + chain.core; ++p) {
    slots_.push_back(slots_of(slots, nodes[p])[0]);
  }
  chain.ends = static_cast<int>(ends_.size());
  for (int p = 0; p < chain.length; ++p) {
    if (chain.in_core(p)) continue;
    const Slot& slot = slots_of(slots, nodes[p]);
    ends_.push_back({p, {slot[0], slot[1], slot[2]}});
  }
  return chains_.emplace_back(chain);
}

LocalIndex BrickChains::slot(const BrickChain& chain, int node, int component) const {
  if (!chain.in_core(node)) {
    const std::size_t number = node < chain.first ? node : node - chain.core;
    return ends(chain)[number].slot[component];
  }
  return slots(chain)[node - chain.first] + component;
}

}  // namespace pounding::stiffness
