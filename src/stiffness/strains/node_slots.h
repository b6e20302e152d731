#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/lanes.h"
#include "common/memory.h"
#include "common/types.h"

namespace pounding {

/// Four rows become four columns.
static inline __attribute__((always_inline)) void transpose(Lanes& a, Lanes& b, Lanes& c,
                                                            Lanes& d) {
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Copies of nodes with 3 or 6 components, in the order in which elements ask for them first, 4 or
/// 8 values apart: what neighbours share is close, and no node crosses a cache line. The values and
/// forces of clamped components stay there.
///
///     slot 0: of nodes that do not move, and of lanes without an element
template <std::size_t components>
class NodeSlots {
 public:
  /// `owned_dofs` as in DofPlaces.
  NodeSlots(LocalIndex owned_dofs, std::size_t nodes)
      : owned_dofs_(owned_dofs), slot_of_node_(nodes, 0), start_(1, -1) {}

  /// Start of a node's slot; `places` as in DofPlaces.
  std::uint32_t start_of(std::size_t node, const std::array<LocalIndex, 6>& places) {
    bool moves = false;
    bool whole = true;
    for (std::size_t c = 0; c < components; ++c) {
      moves = moves || places[c] >= 0;
      whole = whole && places[c] >= 0 && places[c] == places[0] + static_cast<LocalIndex>(c);
    }
    std::uint32_t& slot = slot_of_node_[node];
    if (moves && slot == 0) {
      slot = static_cast<std::uint32_t>(start_.size());
      start_.push_back(whole ? places[0] : -1);
      for (std::size_t c = 0; !whole && c < components; ++c) {
        if (places[c] >= 0) single_.push_back({places[c], slot * stride + c});
      }
    }
    return slot * static_cast<std::uint32_t>(stride);
  }

  /// Once every node has been asked for.
  void finish() {
    slot_of_node_ = {};
    values_ = LaneArray(stride * start_.size(), 0.0);
    forces_ = values_;
  }

  /// Takes w; three values beyond its last place are read.
  void read(const double* w) const {
    double* to = values_.data();
    for (const LocalIndex start : start_) {
      if (start >= 0) {
        Lanes first;
        load(w + start, first);
        store(to, first);
        if constexpr (components == 6) {
          HalfLanes rest;
          load(w + start + 4, rest);
          store(to + 4, rest);
        }
      }
      to += stride;
    }
    for (const auto& [place, at] : single_) values_[at] = w[place];
  }

  /// Adds the forces of owned dofs to q and starts anew.
  void add_to(double* q) const {
    double* from = forces_.data();
    for (const LocalIndex start : start_) {
      if (start >= 0 && start < owned_dofs_) {
        double* const to = q + start;
        for (std::size_t c = 0; c < components; ++c) to[c] += from[c];
      }
      from += stride;
    }
    for (const auto& [place, at] : single_) {
      if (place < owned_dofs_) q[place] += forces_[at];
    }
    std::fill(forces_.begin(), forces_.end(), 0.0);
  }

  /// The components of one node of each of four elements.
  __attribute__((always_inline)) void gather(const std::array<std::uint32_t, lane_count>& start,
                                             Lanes* values) const {
    const double* const w = values_.data();
    Lanes fourth;
    Lanes& last = components == 3 ? fourth : values[3];
    load(w + start[0], values[0]);
    load(w + start[1], values[1]);
    load(w + start[2], values[2]);
    load(w + start[3], last);
    transpose(values[0], values[1], values[2], last);
    if constexpr (components == 6) {
      HalfLanes half[lane_count];
      for (std::size_t lane = 0; lane < lane_count; ++lane) load(w + start[lane] + 4, half[lane]);
      const Lanes even = __builtin_shufflevector(half[0], half[2], 0, 1, 2, 3);
      const Lanes odd = __builtin_shufflevector(half[1], half[3], 0, 1, 2, 3);
      values[4] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
      values[5] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
    }
  }

  /// Adds to the forces of one node of each of four elements, one after the other: they may be the
  /// same node.
  __attribute__((always_inline)) void scatter(
      const Lanes* values, const std::array<std::uint32_t, lane_count>& start) const {
    Lanes first[lane_count] = {values[0], values[1], values[2],
                               components == 3 ? Lanes{} : values[3]};
    transpose(first[0], first[1], first[2], first[3]);
    HalfLanes rest[lane_count];
    if constexpr (components == 6) {
      const Lanes even = __builtin_shufflevector(values[4], values[5], 0, 4, 2, 6);
      const Lanes odd = __builtin_shufflevector(values[4], values[5], 1, 5, 3, 7);
      rest[0] = __builtin_shufflevector(even, even, 0, 1);
      rest[1] = __builtin_shufflevector(odd, odd, 0, 1);
      rest[2] = __builtin_shufflevector(even, even, 2, 3);
      rest[3] = __builtin_shufflevector(odd, odd, 2, 3);
    }
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      double* const node = forces_.data() + start[lane];
      Lanes sum;
      load(node, sum);
      store(node, sum + first[lane]);
      if constexpr (components == 6) {
        HalfLanes sum_of_rest;
        load(node + 4, sum_of_rest);
        store(node + 4, sum_of_rest + rest[lane]);
      }
    }
  }

 private:
  static constexpr std::size_t stride = components == 3 ? 4 : 8;

  LocalIndex owned_dofs_;
  std::vector<std::uint32_t> slot_of_node_;  ///< while slots are given out
  std::vector<LocalIndex> start_;            ///< per slot: place of the first dof if all follow it
  std::vector<std::pair<LocalIndex, std::size_t>> single_;  ///< place and copy of other dofs
  mutable LaneArray values_;
  mutable LaneArray forces_;  ///< zero between products
};

}  // namespace pounding
