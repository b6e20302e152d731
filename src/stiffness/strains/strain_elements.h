#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "common/lanes.h"
#include "common/memory.h"
#include "common/types.h"
#include "stiffness/strains/element_lanes.h"
#include "stiffness/strains/node_slots.h"

namespace pounding::stiffness {

/// Elements of general shape by their strains, a batch of four or eight at a time: K = B' S B,
/// where B takes the displacements to those strains that are not rigid motions. An element keeps
/// the few numbers of its B and S, `Shape::Numbers`, instead of a matrix. S is symmetric to the
/// bit, and B' applies the very numbers of B: so is K, and rigid motions give nothing beyond the
/// round-off of their differences. Nodes have copies in the order of the elements, see NodeSlots.
///
/// `Shape`: node_count, components (3 or 6 per node), number_count, the type Number of these, and
/// `static void product(Numbers numbers, ElementLanes* values)`, which puts forces in the place of
/// displacements, node by node: those of a batch of elements, or of one in several runs.
template <typename Shape>
class StrainElements {
 public:
  using Numbers = std::array<typename Shape::Number, Shape::number_count>;

  struct Element {
    std::size_t shape;                                ///< which of the shapes
    std::array<LocalIndex, Shape::node_count> nodes;  ///< local nodes of the mesh
  };

  /// Elements that are close to each other should follow each other. `owned_dofs`, `of_node` as in
  /// DofSlots.
  StrainElements(const std::vector<Numbers>& shapes, const std::vector<Element>& elements,
                 LocalIndex owned_dofs, const std::vector<std::array<LocalIndex, 6>>& of_node);

  /// q += K w on owned dofs; both arrays hold all slots, w three values beyond them. Allocates
  /// nothing.
  void apply(const double* w, double* q) const;

 private:
  /// Shapes with so many elements have lanes of their own; others share their lanes.
  static constexpr std::size_t many = 16;

  struct Batch {
    std::array<typename NodeSlots<Shape::components>::Starts, Shape::node_count> start{};
    std::size_t numbers = 0;  ///< where they begin
    std::size_t slots = 0;    ///< of the nodes of the batches so far
  };
  /// Batches whose nodes get their slots at once: those stay in the near caches, and the places of
  /// their displacements are looked up side by side.
  static constexpr std::size_t slotted_together = 64;

  void begin_numbers(std::span<const Numbers* const> lanes);
  void begin_slots(const double* w, std::size_t first_batch) const;
  void fetch_numbers_after(std::size_t batch) const;
  void put(const Element& element, std::size_t lane,
           const std::vector<std::array<LocalIndex, 6>>& of_node);

  std::vector<Batch> batches_;
  std::vector<typename Shape::Number, LargePageAllocator<typename Shape::Number>> numbers_;
  NodeSlots<Shape::components> slots_;
};

template <typename Shape>
StrainElements<Shape>::StrainElements(const std::vector<Numbers>& shapes,
                                      const std::vector<Element>& elements, LocalIndex owned_dofs,
                                      const std::vector<std::array<LocalIndex, 6>>& of_node)
    : slots_(owned_dofs, of_node.size()) {
  std::vector<std::vector<const Element*>> of_shape(shapes.size());
  std::vector<std::size_t> in_order;  // shapes as they first appear
  for (const Element& element : elements) {
    if (of_shape[element.shape].empty()) in_order.push_back(element.shape);
    of_shape[element.shape].push_back(&element);
  }
  std::map<std::size_t, std::vector<std::size_t>> by_count;  // elements of a shape -> such shapes
  for (const std::size_t shape : in_order) {
    const auto& alike = of_shape[shape];
    if (alike.size() < many) {
      by_count[alike.size()].push_back(shape);
      continue;
    }
    const Numbers* const numbers = &shapes[shape];
    std::array<const Numbers*, element_lane_count> same{};
    same.fill(numbers);
    begin_numbers(same);
    const std::size_t begin = numbers_.size() - Shape::number_count * element_lane_count;
    for (std::size_t e = 0; e < alike.size(); ++e) {
      if (e % element_lane_count == 0) batches_.push_back({{}, begin, 0});
      put(*alike[e], e % element_lane_count, of_node);
    }
  }
  for (const auto& [count, alike] : by_count) {
    for (std::size_t first = 0; first < alike.size(); first += element_lane_count) {
      const std::size_t used = std::min(element_lane_count, alike.size() - first);
      std::vector<const Numbers*> lanes;
      for (std::size_t lane = 0; lane < used; ++lane) lanes.push_back(&shapes[alike[first + lane]]);
      begin_numbers(lanes);
      const std::size_t begin = numbers_.size() - Shape::number_count * element_lane_count;
      for (std::size_t e = 0; e < count; ++e) {
        batches_.push_back({{}, begin, 0});
        for (std::size_t lane = 0; lane < used; ++lane) {
          put(*of_shape[alike[first + lane]][e], lane, of_node);
        }
      }
    }
  }
  slots_.finish();
}

template <typename Shape>
void StrainElements<Shape>::begin_numbers(std::span<const Numbers* const> lanes) {
  for (std::size_t k = 0; k < Shape::number_count; ++k) {
    for (std::size_t lane = 0; lane < element_lane_count; ++lane) {
      numbers_.push_back(lane < lanes.size() ? (*lanes[lane])[k] : 0);
    }
  }
}

template <typename Shape>
void StrainElements<Shape>::put(const Element& element, std::size_t lane,
                                const std::vector<std::array<LocalIndex, 6>>& of_node) {
  for (std::size_t a = 0; a < Shape::node_count; ++a) {
    const auto node = static_cast<std::size_t>(element.nodes[a]);
    batches_.back().start[a][lane] = slots_.start_of(node, of_node[node]);
  }
  batches_.back().slots = slots_.count();
}

/// Slots of nodes that no batch before these has.
template <typename Shape>
void StrainElements<Shape>::begin_slots(const double* w, std::size_t first_batch) const {
  const std::size_t last = std::min(first_batch + slotted_together, batches_.size()) - 1;
  slots_.begin(w, first_batch == 0 ? 0 : batches_[first_batch - 1].slots, batches_[last].slots);
}

/// Asks memory for the numbers of the next batch unless they are those of this one: a product reads
/// little else, and the processor sees no further than a page by itself.
template <typename Shape>
__attribute__((always_inline)) inline void StrainElements<Shape>::fetch_numbers_after(
    std::size_t batch) const {
  if (batch + 1 == batches_.size()) return;
  const std::size_t next = batches_[batch + 1].numbers;
  if (next == batches_[batch].numbers) return;
  const auto* const first = reinterpret_cast<const char*>(&numbers_[next]);
  constexpr std::size_t bytes =
      Shape::number_count * element_lane_count * sizeof(typename Shape::Number);
  for (std::size_t line = 0; line < bytes; line += cache_line) __builtin_prefetch(first + line);
}

template <typename Shape>
void StrainElements<Shape>::apply(const double* w, double* q) const {
  if (batches_.empty()) return;
  slots_.read_single(w);
  ElementLanes values[Shape::node_count * Shape::components];
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    const Batch& batch = batches_[b];
    if (b % slotted_together == 0) begin_slots(w, b);
    fetch_numbers_after(b);
    for (std::size_t a = 0; a < Shape::node_count; ++a) {
      slots_.gather(batch.start[a], values + a * Shape::components);
    }
    Shape::product(NumbersOfBatch{&numbers_[batch.numbers]}, values);
    for (std::size_t a = 0; a < Shape::node_count; ++a) {
      slots_.scatter(values + a * Shape::components, batch.start[a]);
    }
  }
  slots_.add_to(q);
}

}  // namespace pounding::stiffness
