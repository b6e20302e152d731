#pragma once

#include <cstddef>

#include "stiffness/strains/element_lanes.h"

/// Sums of products of a batch of elements, rounded once per product where the machine can.
namespace pounding::stiffness {

/// a b + c
static inline __attribute__((always_inline)) ElementLanes plus(ElementLanes c,
                                                               const ElementLanes& a,
                                                               const ElementLanes& b) {
  add_product(a, b, c);
  return c;
}

/// c - a b
static inline __attribute__((always_inline)) ElementLanes less(ElementLanes c,
                                                               const ElementLanes& a,
                                                               const ElementLanes& b) {
  subtract_product(a, b, c);
  return c;
}

/// Values of a symmetric matrix of this size in `packed_product`.
constexpr std::size_t packed_size(std::size_t size) {
  return size * (size + 1) / 2;
}

/// force = S strain; S row by row of its lower triangle.
template <std::size_t size>
static inline __attribute__((always_inline)) void packed_product(const ElementLanes* matrix,
                                                                 const ElementLanes* strain,
                                                                 ElementLanes* force) {
#pragma GCC unroll 16
  for (std::size_t i = 0; i < size; ++i) {
    const ElementLanes* const row = matrix + packed_size(i);
    ElementLanes sum = row[i] * strain[i];
#pragma GCC unroll 16
    for (std::size_t j = 0; j < i; ++j) {
      sum = plus(sum, row[j], strain[j]);
      force[j] = plus(force[j], row[j], strain[i]);
    }
    force[i] = sum;
  }
}

/// Turns vectors of three components into axes (three rows of three numbers).
template <std::size_t count>
static inline __attribute__((always_inline)) void turn_into(const ElementLanes* axes,
                                                            ElementLanes* vectors) {
#pragma GCC unroll 8
  for (std::size_t v = 0; v < 3 * count; v += 3) {
    const ElementLanes x = vectors[v], y = vectors[v + 1], z = vectors[v + 2];
    vectors[v] = plus(plus(axes[0] * x, axes[1], y), axes[2], z);
    vectors[v + 1] = plus(plus(axes[3] * x, axes[4], y), axes[5], z);
    vectors[v + 2] = plus(plus(axes[6] * x, axes[7], y), axes[8], z);
  }
}

/// Turns them back.
template <std::size_t count>
static inline __attribute__((always_inline)) void turn_back(const ElementLanes* axes,
                                                            ElementLanes* vectors) {
#pragma GCC unroll 8
  for (std::size_t v = 0; v < 3 * count; v += 3) {
    const ElementLanes x = vectors[v], y = vectors[v + 1], z = vectors[v + 2];
    vectors[v] = plus(plus(axes[0] * x, axes[3], y), axes[6], z);
    vectors[v + 1] = plus(plus(axes[1] * x, axes[4], y), axes[7], z);
    vectors[v + 2] = plus(plus(axes[2] * x, axes[5], y), axes[8], z);
  }
}

}  // namespace pounding::stiffness
