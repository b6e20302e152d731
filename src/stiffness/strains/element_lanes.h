#pragma once

/// One number of each element of a batch, as many as a vector of the unit holds. Nodes of elements
/// stand in rows, component by component, which become columns and rows again.

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/wide_lanes.h"

namespace pounding::stiffness {

/// Elements of a batch.
inline constexpr std::size_t element_lane_count = wide_lane_count;

using ElementLanes = WideLanes;

// Numbers as doubles, one for each lane. The compiler's own conversion of vectors takes two halves.
static inline __attribute__((always_inline)) ElementLanes widened(const double* from) {
  ElementLanes to;
  load(from, to);
  return to;
}
static inline __attribute__((always_inline)) ElementLanes widened(const float* from) {
#if defined(__AVX512F__)
  return _mm512_maskz_cvtps_pd(0xff, _mm256_loadu_ps(from));  // unmasked, g++ 12 sees a false alarm
#elif defined(__AVX__)
  return _mm256_cvtps_pd(_mm_loadu_ps(from));
#else
  return ElementLanes{from[0], from[1], from[2], from[3]};
#endif
}

/// Numbers of the elements of a batch, in 64 or 32 bits.
template <typename Number>
struct NumbersOfBatch {
  const Number* first;

  __attribute__((always_inline)) ElementLanes operator[](std::size_t k) const {
    return widened(first + k * element_lane_count);
  }
  NumbersOfBatch operator+(std::size_t k) const { return {first + k * element_lane_count}; }
};

/// Numbers of one element, each in all lanes: for its products in several runs at once.
template <typename Number>
struct NumbersOfOne {
  const Number* first;

  __attribute__((always_inline)) ElementLanes operator[](std::size_t k) const {
    return all_wide(first[k]);
  }
  NumbersOfOne operator+(std::size_t k) const { return {first + k}; }
};

/// Two values of every other element from the first one on.
template <typename Vector>
static inline __attribute__((always_inline)) void load_half_rows(const double* from,
                                                                 const std::uint32_t* start,
                                                                 Vector& rows) {
  const auto pair = [&](std::size_t first) __attribute__((always_inline)) {
    HalfLanes low, high;
    load(from + start[first], low);
    load(from + start[first + 2], high);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
  };
  if constexpr (sizeof(Vector) == sizeof(Lanes)) {
    rows = pair(0);
  } else {
    rows = __builtin_shufflevector(pair(0), pair(4), 0, 1, 2, 3, 4, 5, 6, 7);
  }
}

/// Adds the lanes from `first` on, as many as a `Part` has, to the values there.
template <std::size_t first, typename Part>
static inline __attribute__((always_inline)) void add_part(const ElementLanes& values, double* to) {
  Part part, sum;
  if constexpr (sizeof part == sizeof(ElementLanes)) {
    std::memcpy(&part, &values, sizeof part);
  } else if constexpr (sizeof part == sizeof(Lanes)) {
    part = __builtin_shufflevector(values, values, first, first + 1, first + 2, first + 3);
  } else {
    part = __builtin_shufflevector(values, values, first, first + 1);
  }
  load(to, sum);
  store(to, sum + part);
}

// Sums of products of a batch of elements, rounded once per product where the machine can.

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
template <std::size_t size, typename Numbers>
static inline __attribute__((always_inline)) void packed_product(Numbers matrix,
                                                                 const ElementLanes* strain,
                                                                 ElementLanes* force) {
#pragma GCC unroll 16
  for (std::size_t i = 0; i < size; ++i) {
    const Numbers row = matrix + packed_size(i);
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
template <std::size_t count, typename Numbers>
static inline __attribute__((always_inline)) void turn_into(Numbers axes, ElementLanes* vectors) {
#pragma GCC unroll 8
  for (std::size_t v = 0; v < 3 * count; v += 3) {
    const ElementLanes x = vectors[v], y = vectors[v + 1], z = vectors[v + 2];
    vectors[v] = plus(plus(axes[0] * x, axes[1], y), axes[2], z);
    vectors[v + 1] = plus(plus(axes[3] * x, axes[4], y), axes[5], z);
    vectors[v + 2] = plus(plus(axes[6] * x, axes[7], y), axes[8], z);
  }
}

/// Turns them back.
template <std::size_t count, typename Numbers>
static inline __attribute__((always_inline)) void turn_back(Numbers axes, ElementLanes* vectors) {
#pragma GCC unroll 8
  for (std::size_t v = 0; v < 3 * count; v += 3) {
    const ElementLanes x = vectors[v], y = vectors[v + 1], z = vectors[v + 2];
    vectors[v] = plus(plus(axes[0] * x, axes[3], y), axes[6], z);
    vectors[v + 1] = plus(plus(axes[1] * x, axes[4], y), axes[7], z);
    vectors[v + 2] = plus(plus(axes[2] * x, axes[5], y), axes[8], z);
  }
}

}  // namespace pounding::stiffness
