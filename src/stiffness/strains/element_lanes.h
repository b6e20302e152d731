#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/lanes.h"

#ifndef POUNDING_KERNELS
#error "Batches are as wide as the vector unit: for kernels alone (cmake/vector_units.cmake)"
#endif

/// One number of each element of a batch: of eight where the unit has AVX-512, else of four.
/// Nodes of elements stand in rows, component by component, which become columns and rows again.
namespace pounding::stiffness {

#ifdef __AVX512F__

/// Elements of a batch.
inline constexpr std::size_t element_lane_count = 8;

using ElementLanes = double __attribute__((vector_size(64)));

/// c += a b and c -= a b, rounded once.
static inline __attribute__((always_inline)) void add_product(const ElementLanes& a,
                                                              const ElementLanes& b,
                                                              ElementLanes& c) {
  c = _mm512_fmadd_pd(a, b, c);
}
static inline __attribute__((always_inline)) void subtract_product(const ElementLanes& a,
                                                                   const ElementLanes& b,
                                                                   ElementLanes& c) {
  c = _mm512_fnmadd_pd(a, b, c);
}

// Lanes a0 a1 a2 a3 and b0 b1 b2 b3 become those named behind, and so every next four:
static inline __attribute__((always_inline)) ElementLanes even_pairs(const ElementLanes& a,
                                                                     const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);  // a0 b0 a2 b2
}
static inline __attribute__((always_inline)) ElementLanes odd_pairs(const ElementLanes& a,
                                                                    const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);  // a1 b1 a3 b3
}
static inline __attribute__((always_inline)) ElementLanes first_halves(const ElementLanes& a,
                                                                       const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);  // a0 a1 b0 b1
}
static inline __attribute__((always_inline)) ElementLanes second_halves(const ElementLanes& a,
                                                                        const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);  // a2 a3 b2 b3
}

/// Four values of element `first`, then of the one four further.
static inline __attribute__((always_inline)) ElementLanes load_rows(
    const double* from, const std::array<std::uint32_t, element_lane_count>& start,
    std::size_t first) {
  Lanes low, high;
  load(from + start[first], low);
  load(from + start[first + 4], high);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Two values of every other element from `first` on.
static inline __attribute__((always_inline)) ElementLanes load_half_rows(
    const double* from, const std::array<std::uint32_t, element_lane_count>& start,
    std::size_t first) {
  HalfLanes half[4];
  for (std::size_t h = 0; h < 4; ++h) load(from + start[first + 2 * h], half[h]);
  const Lanes low = __builtin_shufflevector(half[0], half[1], 0, 1, 2, 3);
  const Lanes high = __builtin_shufflevector(half[2], half[3], 0, 1, 2, 3);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

#else

inline constexpr std::size_t element_lane_count = 4;

using ElementLanes = Lanes;

static inline __attribute__((always_inline)) ElementLanes even_pairs(const ElementLanes& a,
                                                                     const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 0, 4, 2, 6);
}
static inline __attribute__((always_inline)) ElementLanes odd_pairs(const ElementLanes& a,
                                                                    const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 1, 5, 3, 7);
}
static inline __attribute__((always_inline)) ElementLanes first_halves(const ElementLanes& a,
                                                                       const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5);
}
static inline __attribute__((always_inline)) ElementLanes second_halves(const ElementLanes& a,
                                                                        const ElementLanes& b) {
  return __builtin_shufflevector(a, b, 2, 3, 6, 7);
}

static inline __attribute__((always_inline)) ElementLanes load_rows(
    const double* from, const std::array<std::uint32_t, element_lane_count>& start,
    std::size_t first) {
  ElementLanes row;
  load(from + start[first], row);
  return row;
}

static inline __attribute__((always_inline)) ElementLanes load_half_rows(
    const double* from, const std::array<std::uint32_t, element_lane_count>& start,
    std::size_t first) {
  HalfLanes low, high;
  load(from + start[first], low);
  load(from + start[first + 2], high);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}

#endif

/// Every four rows become four columns.
static inline __attribute__((always_inline)) void transpose(ElementLanes& a, ElementLanes& b,
                                                            ElementLanes& c, ElementLanes& d) {
  const ElementLanes ab_even = even_pairs(a, b), ab_odd = odd_pairs(a, b);
  const ElementLanes cd_even = even_pairs(c, d), cd_odd = odd_pairs(c, d);
  a = first_halves(ab_even, cd_even);
  b = first_halves(ab_odd, cd_odd);
  c = second_halves(ab_even, cd_even);
  d = second_halves(ab_odd, cd_odd);
}

/// Adds the lanes from `first` on, as many as a `Part` has, to the values at a place.
template <std::size_t first, typename Part>
static inline __attribute__((always_inline)) void add_part(const ElementLanes& values,
                                                           double* place) {
  Part part, sum;
  if constexpr (sizeof part == sizeof(ElementLanes)) {
    std::memcpy(&part, &values, sizeof part);
  } else if constexpr (sizeof part == sizeof(Lanes)) {
    part = __builtin_shufflevector(values, values, first, first + 1, first + 2, first + 3);
  } else {
    part = __builtin_shufflevector(values, values, first, first + 1);
  }
  load(place, sum);
  store(place, sum + part);
}

}  // namespace pounding::stiffness
