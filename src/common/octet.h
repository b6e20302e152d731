#pragma once

#include <cstddef>
#include <utility>

#include "common/lanes.h"

/// Eight doubles at once, one for each of eight members of an ensemble: one register of AVX-512,
/// two of AVX, four of SSE2. Every operation is done lane by lane and rounded like that of a single
/// double (add_product in lanes.h), so that no lane depends on its neighbours. The alignment is the
/// same for every vector unit: code of all of them reads the same arrays.
namespace pounding {

/// Members that are stepped together.
inline constexpr std::size_t octet_size = 8;

/// Lanes that one register holds: the compiler keeps vectors wider than that in memory.
#if defined(__AVX512F__)
using OctetPart = EightLanes;
#elif defined(__AVX__)
using OctetPart = Lanes;
#else
using OctetPart = HalfLanes;
#endif
using OctetMaskPart = decltype(OctetPart{} < OctetPart{});

inline constexpr std::size_t octet_part_size = sizeof(OctetPart) / sizeof(double);
inline constexpr std::size_t octet_parts = octet_size / octet_part_size;

struct alignas(64) Octet {
  OctetPart parts[octet_parts];

  double operator[](std::size_t lane) const {
    return parts[lane / octet_part_size][lane % octet_part_size];
  }
  void set(std::size_t lane, double value) {
    parts[lane / octet_part_size][lane % octet_part_size] = value;
  }
};

/// Lanes for which something is true.
struct OctetMask {
  OctetMaskPart parts[octet_parts];
};

#define POUNDING_OCTET static inline __attribute__((always_inline))

/// Part by part, each written out, so that all stay in registers.
template <typename Result, typename Operation, typename... Operands>
POUNDING_OCTET Result by_parts(const Operation& operation, const Operands&... operands) {
  const auto part = [&](std::size_t p) __attribute__((always_inline)) {
    return operation(operands.parts[p]...);
  };
  return [&]<std::size_t... p>(std::index_sequence<p...>) __attribute__((always_inline)) {
    return Result{{part(p)...}};
  }
  (std::make_index_sequence<octet_parts>());
}

POUNDING_OCTET Octet all_octet(double value) {
  return by_parts<Octet>([value](const auto& zero) { return zero + value; }, Octet{});
}
POUNDING_OCTET Octet operator+(const Octet& a, const Octet& b) {
  return by_parts<Octet>([](const auto& x, const auto& y) { return x + y; }, a, b);
}
POUNDING_OCTET Octet operator-(const Octet& a, const Octet& b) {
  return by_parts<Octet>([](const auto& x, const auto& y) { return x - y; }, a, b);
}
POUNDING_OCTET Octet operator-(const Octet& a) {
  return by_parts<Octet>([](const auto& x) { return -x; }, a);
}
POUNDING_OCTET Octet operator*(const Octet& a, const Octet& b) {
  return by_parts<Octet>([](const auto& x, const auto& y) { return x * y; }, a, b);
}
POUNDING_OCTET Octet operator+(const Octet& a, double b) {
  return by_parts<Octet>([b](const auto& x) { return x + b; }, a);
}
POUNDING_OCTET Octet operator/(const Octet& a, double b) {
  return by_parts<Octet>([b](const auto& x) { return x / b; }, a);
}
POUNDING_OCTET Octet& operator+=(Octet& a, const Octet& b) {
  return a = a + b;
}

/// c += a b, rounded once where the machine can: by the source, not by the compiler's choice.
POUNDING_OCTET void add_product(const Octet& a, const Octet& b, Octet& c) {
  c = by_parts<Octet>(
      [](const OctetPart& x, const OctetPart& y, OctetPart z) {
        add_product(x, y, z);
        return z;
      },
      a, b, c);
}

/// c -= a b, in every lane.
POUNDING_OCTET void subtract_product(const Octet& a, const Octet& b, Octet& c) {
  add_product(-a, b, c);
}

POUNDING_OCTET OctetMask operator<(const Octet& a, const Octet& b) {
  return by_parts<OctetMask>([](const auto& x, const auto& y) { return x < y; }, a, b);
}
POUNDING_OCTET OctetMask operator<=(const Octet& a, const Octet& b) {
  return by_parts<OctetMask>([](const auto& x, const auto& y) { return x <= y; }, a, b);
}
POUNDING_OCTET OctetMask operator&(const OctetMask& a, const OctetMask& b) {
  return by_parts<OctetMask>([](const auto& x, const auto& y) { return x & y; }, a, b);
}
POUNDING_OCTET OctetMask operator|(const OctetMask& a, const OctetMask& b) {
  return by_parts<OctetMask>([](const auto& x, const auto& y) { return x | y; }, a, b);
}
POUNDING_OCTET bool any(const OctetMask& mask) {
  bool found = false;
  for (const OctetMaskPart& part : mask.parts) {
    for (std::size_t lane = 0; lane < octet_part_size; ++lane) found = found || part[lane] != 0;
  }
  return found;
}

/// Those of a where the mask is true, else those of b.
POUNDING_OCTET Octet choose(const OctetMask& mask, const Octet& a, const Octet& b) {
  return by_parts<Octet>([](const OctetMaskPart& first, const OctetPart& x,
                            const OctetPart& y) { return first ? x : y; },
                         mask, a, b);
}
POUNDING_OCTET Octet magnitude(const Octet& a) {
  return by_parts<Octet>([](const OctetPart& x) { return x < 0 ? -x : x; }, a);
}
POUNDING_OCTET Octet larger(const Octet& a, const Octet& b) {
  return choose(b < a, a, b);
}

/// The number of one of eight runs; a double is that of a run by itself.
POUNDING_OCTET double of_lane(const Octet& value, std::size_t lane) {
  return value[lane];
}
POUNDING_OCTET double of_lane(double value, std::size_t /*lane*/) {
  return value;
}
POUNDING_OCTET void set_lane(Octet& value, std::size_t lane, double number) {
  value.set(lane, number);
}
POUNDING_OCTET void set_lane(double& value, std::size_t /*lane*/, double number) {
  value = number;
}

#undef POUNDING_OCTET

}  // namespace pounding
