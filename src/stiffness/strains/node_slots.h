#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/lanes.h"
#include "common/memory.h"
#include "common/types.h"
#include "stiffness/strains/element_lanes.h"

namespace pounding::stiffness {

/// Copies of nodes with 3 or 6 components, in the order in which elements ask for them first, 4 or
/// 8 values apart: what neighbours share is close, and no node crosses a cache line. The values and
/// forces of clamped components stay there.
///
///     slot 0: of nodes that do not move, and of lanes without an element
template <std::size_t components>
class NodeSlots {
 public:
  /// Starts of the slots of one node of each of the elements of a batch.
  using Starts = std::array<std::uint32_t, element_lane_count>;

  /// `owned_dofs` as in DofSlots.
  NodeSlots(LocalIndex owned_dofs, std::size_t nodes)
      : owned_dofs_(owned_dofs), slot_of_node_(nodes, 0), start_(1, -1) {}

  /// Start of a node's slot; `dofs` as in DofSlots.
  std::uint32_t start_of(std::size_t node, const std::array<LocalIndex, 6>& dofs) {
    bool moves = false;
    bool whole = true;
    for (std::size_t c = 0; c < components; ++c) {
      moves = moves || dofs[c] >= 0;
      whole = whole && dofs[c] >= 0 && dofs[c] == dofs[0] + static_cast<LocalIndex>(c);
    }
    std::uint32_t& slot = slot_of_node_[node];
    if (moves && slot == 0) {
      slot = static_cast<std::uint32_t>(start_.size());
      start_.push_back(whole ? dofs[0] : -1);
      for (std::size_t c = 0; !whole && c < components; ++c) {
        if (dofs[c] >= 0) single_.push_back({dofs[c], slot * stride + c});
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

  /// Slots given out so far.
  std::size_t count() const { return start_.size(); }

  /// Takes the components of w that do not follow each other: before the slots are begun.
  void read_single(const double* w) const {
    for (const auto& [dof, at] : single_) values_[at] = w[dof];
  }

  /// Takes w and begins sums of forces in slots from `begin` to `end`; three values beyond the last
  /// dof of w are read.
  void begin(const double* w, std::size_t begin, std::size_t end) const {
    double* to = values_.data() + stride * begin;
    double* force = forces_.data() + stride * begin;
    for (std::size_t slot = begin; slot < end; ++slot, to += stride, force += stride) {
      store(force, Lanes{});
      if constexpr (components == 6) store(force + 4, HalfLanes{});
      const LocalIndex start = start_[slot];
      if (start < 0) continue;
      Lanes first;
      load(w + start, first);
      store(to, first);
      if constexpr (components == 6) {
        HalfLanes rest;
        load(w + start + 4, rest);
        store(to + 4, rest);
      }
    }
  }

  /// Adds the forces of owned dofs to q.
  void add_to(double* q) const {
    const double* from = forces_.data();
    for (const LocalIndex start : start_) {
      if (start >= 0 && start < owned_dofs_) {
        double* const to = q + start;
        for (std::size_t c = 0; c < components; ++c) to[c] += from[c];
      }
      from += stride;
    }
    for (const auto& [dof, at] : single_) {
      if (dof < owned_dofs_) q[dof] += forces_[at];
    }
  }

  /// The components of one node of each of the elements of a batch.
  __attribute__((always_inline)) void gather(const Starts& start, ElementLanes* values) const {
    const double* const w = values_.data();
    ElementLanes fourth;
    ElementLanes& last = components == 3 ? fourth : values[3];
    for (std::size_t row = 0; row < 3; ++row) load_rows(w, &start[row], values[row]);
    load_rows(w, &start[3], last);
    transpose(values[0], values[1], values[2], last);
    if constexpr (components == 6) {
      ElementLanes even, odd;
      load_half_rows(w + 4, &start[0], even);
      load_half_rows(w + 4, &start[1], odd);
      values[4] = even_pairs(even, odd);
      values[5] = odd_pairs(even, odd);
    }
  }

  /// Adds to the forces of one node of each of the elements, one after the other: they may be the
  /// same node.
  __attribute__((always_inline)) void scatter(const ElementLanes* values,
                                              const Starts& start) const {
    ElementLanes rows[4] = {values[0], values[1], values[2],
                            components == 3 ? ElementLanes{} : values[3]};
    transpose(rows[0], rows[1], rows[2], rows[3]);
    ElementLanes rest[2];  // of even and of odd lanes
    if constexpr (components == 6) {
      rest[0] = even_pairs(values[4], values[5]);
      rest[1] = odd_pairs(values[4], values[5]);
    }
    const auto add = [&]<std::size_t lane>() __attribute__((always_inline)) {
      double* const node = forces_.data() + start[lane];
      add_part<lane / 4 * 4, Lanes>(rows[lane % 4], node);
      if constexpr (components == 6) add_part<lane / 2 * 2, HalfLanes>(rest[lane % 2], node + 4);
    };
    [&]<std::size_t... lane>(std::index_sequence<lane...>) __attribute__((always_inline)) {
      (add.template operator()<lane>(), ...);
    }
    (std::make_index_sequence<element_lane_count>());
  }

 private:
  static constexpr std::size_t stride = components == 3 ? 4 : 8;

  LocalIndex owned_dofs_;
  std::vector<std::uint32_t> slot_of_node_;  ///< while slots are given out
  std::vector<LocalIndex> start_;            ///< per slot: first dof if all follow it
  std::vector<std::pair<LocalIndex, std::size_t>> single_;  ///< other dofs and their copies
  mutable LaneArray values_;
  mutable LaneArray forces_;
};

}  // namespace pounding::stiffness
