#pragma once

#include <cstddef>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

/// Eight doubles at once, one for each of eight members of an ensemble: one register of AVX-512,
/// two of AVX, four of SSE2. Every operation is done lane by lane and rounded like that of a single
/// double (add_product in lanes.h), so that no lane depends on its neighbours. The alignment is the
/// same for every vector unit: code of all of them reads the same arrays.
namespace pounding {

/// Members that are stepped together.
inline constexpr std::size_t octet_size = 8;

struct alignas(64) Octet {
  using Lanes8 = double __attribute__((vector_size(64)));
  Lanes8 lanes;

  double operator[](std::size_t lane) const { return lanes[lane]; }
  void set(std::size_t lane, double value) { lanes[lane] = value; }
};

#define POUNDING_OCTET static inline __attribute__((always_inline))

POUNDING_OCTET Octet all_octet(double value) {
  return {Octet::Lanes8{} + value};
}
POUNDING_OCTET Octet operator+(const Octet& a, const Octet& b) {
  return {a.lanes + b.lanes};
}
POUNDING_OCTET Octet operator-(const Octet& a, const Octet& b) {
  return {a.lanes - b.lanes};
}
POUNDING_OCTET Octet operator-(const Octet& a) {
  return {-a.lanes};
}
POUNDING_OCTET Octet operator*(const Octet& a, const Octet& b) {
  return {a.lanes * b.lanes};
}
POUNDING_OCTET Octet operator+(const Octet& a, double b) {
  return {a.lanes + b};
}
POUNDING_OCTET Octet& operator+=(Octet& a, const Octet& b) {
  a.lanes += b.lanes;
  return a;
}

/// c += a b, rounded once where the machine can: by the source, not by the compiler's choice.
POUNDING_OCTET void add_product(const Octet& a, const Octet& b, Octet& c) {
#if defined(__AVX512F__)
  c.lanes = _mm512_fmadd_pd(a.lanes, b.lanes, c.lanes);
#elif defined(__FMA__)
  for (int half = 0; half < 2; ++half) {
    __m256d x, y, z;
    std::memcpy(&x, reinterpret_cast<const char*>(&a) + 32 * half, sizeof x);
    std::memcpy(&y, reinterpret_cast<const char*>(&b) + 32 * half, sizeof y);
    std::memcpy(&z, reinterpret_cast<const char*>(&c) + 32 * half, sizeof z);
    z = _mm256_fmadd_pd(x, y, z);
    std::memcpy(reinterpret_cast<char*>(&c) + 32 * half, &z, sizeof z);
  }
#else
  c.lanes += a.lanes * b.lanes;
#endif
}

/// c -= a b, in every lane.
POUNDING_OCTET void subtract_product(const Octet& a, const Octet& b, Octet& c) {
  add_product(-a, b, c);
}

POUNDING_OCTET Octet magnitude(const Octet& a) {
  return {a.lanes < 0 ? -a.lanes : a.lanes};
}
POUNDING_OCTET Octet larger(const Octet& a, const Octet& b) {
  return {a.lanes > b.lanes ? a.lanes : b.lanes};
}

#undef POUNDING_OCTET

}  // namespace pounding
