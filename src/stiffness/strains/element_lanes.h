#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/wide_lanes.h"

/// One number of each element of a batch, as many as a vector of the unit holds. Nodes of elements
/// stand in rows, component by component, which become columns and rows again.
namespace pounding::stiffness {

/// Elements of a batch.
inline constexpr std::size_t element_lane_count = wide_lane_count;

using ElementLanes = WideLanes;

#ifdef __AVX512F__

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
