#pragma once

#include <cstdint>

#include "common/lanes.h"

#ifndef POUNDING_KERNELS
#error "As wide as the vector unit: for kernels alone (cmake/vector_units.cmake)"
#endif

/// The widest vectors of the unit: eight doubles with AVX-512, else four.
namespace pounding {

#ifdef __AVX512F__

inline constexpr int wide_lane_count = 8;

using WideLanes = EightLanes;
using WideMask = std::int64_t __attribute__((vector_size(64)));

inline constexpr WideMask lane_numbers{0, 1, 2, 3, 4, 5, 6, 7};

/// A coefficient that all lanes of a narrower vector hold.
static POUNDING_INLINE WideLanes widened(const Lanes& coefficient) {
  return _mm512_set1_pd(coefficient[0]);
}

/// Values i - 1 .. i + 6 and i + 1 .. i + 8 of those before, at and after i .. i + 7.
static POUNDING_INLINE WideLanes shifted_back(const WideLanes& before, const WideLanes& at) {
  return __builtin_shufflevector(before, at, 7, 8, 9, 10, 11, 12, 13, 14);
}
static POUNDING_INLINE WideLanes shifted_on(const WideLanes& at, const WideLanes& after) {
  return __builtin_shufflevector(at, after, 1, 2, 3, 4, 5, 6, 7, 8);
}

#else

inline constexpr int wide_lane_count = lane_count;

using WideLanes = Lanes;
using WideMask = LaneMask;

inline constexpr WideMask lane_numbers{0, 1, 2, 3};

static POUNDING_INLINE const WideLanes& widened(const Lanes& coefficient) {
  return coefficient;
}

/// Values i - 1 .. i + 2 of those before and at i .. i + 3.
static POUNDING_INLINE WideLanes shifted_back(const WideLanes& before, const WideLanes& at) {
  return __builtin_shufflevector(before, at, 3, 4, 5, 6);
}

#endif

static POUNDING_INLINE WideLanes all_wide(double value) {
  return value - WideLanes{};
}

static POUNDING_INLINE void mask_lanes(const WideMask& keep, WideLanes& values) {
  values = (WideLanes)((WideMask)values & keep);
}

// Lanes a0 a1 a2 a3 and b0 b1 b2 b3 become those named behind, and so every next four:
static POUNDING_INLINE Lanes even_pairs(const Lanes& a, const Lanes& b) {
  return __builtin_shufflevector(a, b, 0, 4, 2, 6);  // a0 b0 a2 b2
}
static POUNDING_INLINE Lanes odd_pairs(const Lanes& a, const Lanes& b) {
  return __builtin_shufflevector(a, b, 1, 5, 3, 7);  // a1 b1 a3 b3
}
static POUNDING_INLINE Lanes first_halves(const Lanes& a, const Lanes& b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5);  // a0 a1 b0 b1
}
static POUNDING_INLINE Lanes second_halves(const Lanes& a, const Lanes& b) {
  return __builtin_shufflevector(a, b, 2, 3, 6, 7);  // a2 a3 b2 b3
}

#ifdef __AVX512F__
static POUNDING_INLINE WideLanes even_pairs(const WideLanes& a, const WideLanes& b) {
  return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
}
static POUNDING_INLINE WideLanes odd_pairs(const WideLanes& a, const WideLanes& b) {
  return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
}
static POUNDING_INLINE WideLanes first_halves(const WideLanes& a, const WideLanes& b) {
  return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
}
static POUNDING_INLINE WideLanes second_halves(const WideLanes& a, const WideLanes& b) {
  return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}
#endif

/// Every four rows become four columns.
template <typename Vector>
static POUNDING_INLINE void transpose(Vector& a, Vector& b, Vector& c, Vector& d) {
  const Vector ab_even = even_pairs(a, b), ab_odd = odd_pairs(a, b);
  const Vector cd_even = even_pairs(c, d), cd_odd = odd_pairs(c, d);
  a = first_halves(ab_even, cd_even);
  b = first_halves(ab_odd, cd_odd);
  c = second_halves(ab_even, cd_even);
  d = second_halves(ab_odd, cd_odd);
}

/// Four values from from[start[0]] on; of a vector of eight those from from[start[4]] on behind.
template <typename Vector, typename Start>
static POUNDING_INLINE void load_rows(const double* from, const Start* start, Vector& rows) {
  if constexpr (sizeof(Vector) == sizeof(Lanes)) {
    load(from + start[0], rows);
  } else {
    Lanes low, high;
    load(from + start[0], low);
    load(from + start[4], high);
    rows = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
}
/// The way back.
template <typename Vector, typename Start>
static POUNDING_INLINE void store_rows(const Vector& rows, const Start* start, double* to) {
  if constexpr (sizeof(Vector) == sizeof(Lanes)) {
    store(to + start[0], rows);
  } else {
    store(to + start[0], Lanes(__builtin_shufflevector(rows, rows, 0, 1, 2, 3)));
    store(to + start[4], Lanes(__builtin_shufflevector(rows, rows, 4, 5, 6, 7)));
  }
}

/// Calls group(vector, p) for as many of `count` nodes from node p on as a vector has lanes; the
/// last group may overlap the one before it. Calls one(p) for each node if they fill no vector.
template <typename Group, typename One>
static POUNDING_INLINE void in_groups(int count, Group group, One one) {
  const auto in_vectors = [&]<typename Vector>(Vector vector) {
    constexpr int width = sizeof(Vector) / sizeof(double);
    for (int p = 0; p + width <= count; p += width) group(vector, p);
    if (count % width != 0) group(vector, count - width);
  };
  if (count >= wide_lane_count) {
    in_vectors(WideLanes{});
  } else if (count >= lane_count) {
    in_vectors(Lanes{});
  } else {
    for (int p = 0; p < count; ++p) one(p);
  }
}

}  // namespace pounding
