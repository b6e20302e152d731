#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/batch_value.h"
#include "common/types.h"
#include "stiffness/strains/element_lanes.h"
#include "stiffness/strains/strain_elements.h"

namespace pounding::stiffness {

/// Windows of a product in eight runs: the dofs follow each other in windows, and an element is
/// applied in that of its lowest dof. The forces of a window are final after its elements. Values
/// of the dofs that are in use lie in a ring, which is as long as elements reach.
struct BatchWindows {
  static constexpr LocalIndex dofs = 256;  ///< of a window

  std::vector<LocalIndex> reach;  ///< per window: one beyond the last dof in use until its end
  std::vector<LocalIndex> turns;  ///< elements and rows of each window
  LocalIndex ring = dofs;         ///< places; a power of two

  explicit BatchWindows(LocalIndex all) {
    for (LocalIndex end = dofs; end < all + dofs; end += dofs) reach.push_back(std::min(end, all));
    turns.resize(reach.size());
  }
  /// An element touches the dofs from `lowest` to `highest`.
  void add(LocalIndex lowest, LocalIndex highest) {
    LocalIndex& end = reach[lowest / dofs];
    end = std::max(end, highest + 1);
    ++turns[lowest / dofs];
  }
  /// After all elements.
  void finish() {
    for (std::size_t k = 0; k < reach.size(); ++k) {
      if (k > 0) reach[k] = std::max(reach[k], reach[k - 1]);
      while (ring < reach[k] - static_cast<LocalIndex>(k) * dofs) ring *= 2;
    }
  }
  std::uint32_t place(LocalIndex dof) const { return static_cast<std::uint32_t>(dof & (ring - 1)); }
};

/// Asks memory for the state that comes into use with the next window, an equal part of it at the
/// turn of each element: memory and arithmetic work at the same time.
class StateAhead {
 public:
  StateAhead(const BatchWindows& windows, std::size_t window, const BatchValue* displacement,
             const BatchValue* velocity)
      : displacement_(displacement),
        velocity_(velocity),
        next_(windows.reach[window]),
        end_(windows.reach[std::min(window + 1, windows.reach.size() - 1)]),
        part_((end_ - next_) / std::max(windows.turns[window], 1) + 1) {}

  void ask() {
    for (const LocalIndex end = std::min(next_ + part_, end_); next_ < end; ++next_) {
      __builtin_prefetch(displacement_ + next_);
      __builtin_prefetch(velocity_ + next_);
    }
  }

 private:
  const BatchValue* displacement_;
  const BatchValue* velocity_;
  LocalIndex next_, end_, part_;
};

/// Places in a list, in the order of lowest dofs, where the entries of each window begin; then its
/// end.
template <typename Entry>
std::vector<std::size_t> begins_in(const BatchWindows& windows, const std::vector<Entry>& entries,
                                   const auto& lowest) {
  std::vector<std::size_t> begins{0};
  for (std::size_t k = 1; k <= windows.reach.size(); ++k) {
    std::size_t begin = begins.back();
    const auto first = static_cast<LocalIndex>(k) * BatchWindows::dofs;
    while (begin < entries.size() && lowest(entries[begin]) < first) ++begin;
    begins.push_back(begin);
  }
  return begins;
}

/// Elements of one kind, applied in eight runs at once, one after the other: the values of a dof in
/// the runs are whole vectors, and the numbers of an element are those of all runs. `Shape`: see
/// StrainElements; `product` is called with NumbersOfOne.
template <typename Shape>
class BatchElements {
 public:
  static constexpr std::size_t dof_count = Shape::node_count * Shape::components;
  using Numbers = std::array<typename Shape::Number, Shape::number_count>;

  struct Element {
    std::size_t shape;                       ///< which of the shapes
    std::array<LocalIndex, dof_count> dofs;  ///< node by node; -1: clamped
  };

  BatchElements(const std::vector<Numbers>& shapes, std::vector<Element> elements)
      : elements_(std::move(elements)) {
    std::erase_if(elements_, [](const Element& e) { return std::ranges::max(e.dofs) < 0; });
    std::ranges::stable_sort(elements_, {}, lowest);
    std::vector<std::size_t> place(shapes.size(), shapes.size());  // in the order of their use
    for (Element& element : elements_) {
      std::size_t& found = place[element.shape];
      if (found == shapes.size()) {
        found = shapes_.size();
        shapes_.push_back(shapes[element.shape]);
      }
      element.shape = found;
    }
  }
  /// Elements by their nodes, as StrainElements takes them.
  BatchElements(const std::vector<Numbers>& shapes,
                const std::vector<typename StrainElements<Shape>::Element>& elements,
                LocalIndex /*owned_dofs*/, const std::vector<std::array<LocalIndex, 6>>& of_node)
      : BatchElements(shapes, by_dofs(elements, of_node)) {}

  void add_to(BatchWindows& windows) const {
    for (const Element& e : elements_) windows.add(lowest(e), std::ranges::max(e.dofs));
  }
  /// After all have been added to the windows. Clamped dofs have the place after the ring.
  void place_in(const BatchWindows& windows) {
    begins_ = begins_in(windows, elements_, lowest);
    for (const Element& element : elements_) {
      Placed& placed = placed_.emplace_back();
      placed.shape = static_cast<std::uint32_t>(element.shape);
      for (std::size_t i = 0; i < dof_count; ++i) {
        const LocalIndex dof = element.dofs[i];
        placed.at[i] = dof < 0 ? static_cast<std::uint32_t>(windows.ring) : windows.place(dof);
      }
    }
    elements_ = {};
  }

  /// q += K w of the elements of a window, both in the ring. Compiled with the product of the shape
  /// (batch_product.h), of which it is the only caller.
  void apply(std::size_t window, const BatchValue* w, BatchValue* q, StateAhead& ahead) const;

 private:
  struct Placed {
    std::uint32_t shape;
    std::array<std::uint32_t, dof_count> at;
  };

  /// Dofs that are clamped do not count.
  static LocalIndex lowest(const Element& element) {
    LocalIndex found = std::ranges::max(element.dofs);
    for (const LocalIndex dof : element.dofs) found = dof < 0 ? found : std::min(found, dof);
    return found;
  }
  static std::vector<Element> by_dofs(
      const std::vector<typename StrainElements<Shape>::Element>& elements,
      const std::vector<std::array<LocalIndex, 6>>& of_node) {
    std::vector<Element> result;
    result.reserve(elements.size());
    for (const auto& element : elements) {
      Element& entry = result.emplace_back(Element{element.shape, {}});
      for (std::size_t i = 0; i < dof_count; ++i) {
        entry.dofs[i] = of_node[element.nodes[i / Shape::components]][i % Shape::components];
      }
    }
    return result;
  }

  std::vector<Numbers> shapes_;
  std::vector<Element> elements_;    ///< until they are placed
  std::vector<Placed> placed_;       ///< in the order of their lowest dofs
  std::vector<std::size_t> begins_;  ///< of each window, and the end
};

}  // namespace pounding::stiffness
