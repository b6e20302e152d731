#pragma once

#include <cstdint>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

/// Parts of a kernel that must not become calls.
#define POUNDING_INLINE inline __attribute__((always_inline))

/// Four doubles at once, by the compiler's vector types: AVX where the unit has it, two SSE halves
/// elsewhere.
namespace pounding {

/// Doubles that one vector instruction takes at once.
inline constexpr int lane_count = 4;

/// Doubles that the widest vector of any unit takes at once (wide_lanes.h): arrays that vectors
/// write have room for so many beyond their end, less one.
inline constexpr int most_lanes = 8;

using Lanes = double __attribute__((vector_size(32)));
using LaneMask = std::int64_t __attribute__((vector_size(32)));
using HalfLanes = double __attribute__((vector_size(16)));

/// Vectors from memory and back.
template <typename Vector>
static POUNDING_INLINE void load(const double* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
template <typename Vector>
static POUNDING_INLINE void store(double* to, const Vector& from) {
  std::memcpy(to, &from, sizeof from);
}

static POUNDING_INLINE Lanes all_lanes(double value) {
  return Lanes{value, value, value, value};
}
static POUNDING_INLINE double add_up(const Lanes& values) {
  return (values[0] + values[2]) + (values[1] + values[3]);
}
static POUNDING_INLINE double add_up(const HalfLanes& values) {
  return values[0] + values[1];
}
static POUNDING_INLINE double add_up(double value) {
  return value;
}

/// c += a b, rounded once where the machine can: by the source, not by the compiler's choice.
static POUNDING_INLINE void add_product(const Lanes& a, const Lanes& b, Lanes& c) {
#ifdef __FMA__
  c = _mm256_fmadd_pd(a, b, c);
#else
  c += a * b;
#endif
}

static POUNDING_INLINE void add_product(const HalfLanes& a, const HalfLanes& b, HalfLanes& c) {
#ifdef __FMA__
  c = _mm_fmadd_pd(a, b, c);
#else
  c += a * b;
#endif
}

/// Multiplies and adds single values, rounded like those of a vector: the rest of a range must not
/// move otherwise than the range itself.
static POUNDING_INLINE void add_product(double a, double b, double& c) {
#ifdef __FMA__
  c = __builtin_fma(a, b, c);
#else
  c += a * b;
#endif
}

/// c -= a b, in every lane.
static POUNDING_INLINE void subtract_product(double a, double b, double& c) {
  add_product(-a, b, c);
}
static POUNDING_INLINE void subtract_product(const Lanes& a, const Lanes& b, Lanes& c) {
#ifdef __FMA__
  c = _mm256_fnmadd_pd(a, b, c);
#else
  c -= a * b;
#endif
}

#ifdef __AVX512F__

/// Eight doubles at once.
using EightLanes = double __attribute__((vector_size(64)));

static POUNDING_INLINE double add_up(const EightLanes& values) {
  return add_up(Lanes(__builtin_shufflevector(values, values, 0, 1, 2, 3)) +
                Lanes(__builtin_shufflevector(values, values, 4, 5, 6, 7)));
}

/// c += a b and c -= a b, rounded once.
static POUNDING_INLINE void add_product(const EightLanes& a, const EightLanes& b, EightLanes& c) {
  c = _mm512_fmadd_pd(a, b, c);
}
static POUNDING_INLINE void subtract_product(const EightLanes& a, const EightLanes& b,
                                             EightLanes& c) {
  c = _mm512_fnmadd_pd(a, b, c);
}

#endif

}  // namespace pounding
