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
inline constexpr std::size_t batch_size = 8;

/// Lanes that one register holds: the compiler keeps vectors wider than that in memory.
#if defined(__AVX512F__)
using BatchPart = EightLanes;
#elif defined(__AVX__)
using BatchPart = Lanes;
#else
using BatchPart = HalfLanes;
#endif
using BatchMaskPart = decltype(BatchPart{} < BatchPart{});

inline constexpr std::size_t batch_part_size = sizeof(BatchPart) / sizeof(double);
inline constexpr std::size_t batch_parts = batch_size / batch_part_size;

struct alignas(64) BatchValue {
  BatchPart parts[batch_parts];

  double operator[](std::size_t lane) const {
    return parts[lane / batch_part_size][lane % batch_part_size];
  }
  void set(std::size_t lane, double value) {
    parts[lane / batch_part_size][lane % batch_part_size] = value;
  }
};

/// Lanes for which something is true.
struct BatchMask {
  BatchMaskPart parts[batch_parts];
};

#define POUNDING_BATCH static inline __attribute__((always_inline))

/// Part by part, each written out, so that all stay in registers.
template <typename Result, typename Operation, typename... Operands>
POUNDING_BATCH Result by_parts(const Operation& operation, const Operands&... operands) {
  const auto part = [&](std::size_t p) __attribute__((always_inline)) {
    return operation(operands.parts[p]...);
  };
  return [&]<std::size_t... p>(std::index_sequence<p...>) __attribute__((always_inline)) {
    return Result{{part(p)...}};
  }
  (std::make_index_sequence<batch_parts>());
}

POUNDING_BATCH BatchValue all_eight(double value) {
  return by_parts<BatchValue>([value](const auto& zero) { return zero + value; }, BatchValue{});
}
POUNDING_BATCH BatchValue operator+(const BatchValue& a, const BatchValue& b) {
  return by_parts<BatchValue>([](const auto& x, const auto& y) { return x + y; }, a, b);
}
POUNDING_BATCH BatchValue operator-(const BatchValue& a, const BatchValue& b) {
  return by_parts<BatchValue>([](const auto& x, const auto& y) { return x - y; }, a, b);
}
POUNDING_BATCH BatchValue operator-(const BatchValue& a) {
  return by_parts<BatchValue>([](const auto& x) { return -x; }, a);
}
POUNDING_BATCH BatchValue operator*(const BatchValue& a, const BatchValue& b) {
  return by_parts<BatchValue>([](const auto& x, const auto& y) { return x * y; }, a, b);
}
POUNDING_BATCH BatchValue operator+(const BatchValue& a, double b) {
  return by_parts<BatchValue>([b](const auto& x) { return x + b; }, a);
}
POUNDING_BATCH BatchValue operator/(const BatchValue& a, double b) {
  return by_parts<BatchValue>([b](const auto& x) { return x / b; }, a);
}
POUNDING_BATCH BatchValue& operator+=(BatchValue& a, const BatchValue& b) {
  return a = a + b;
}

/// c += a b, rounded once where the machine can: by the source, not by the compiler's choice.
POUNDING_BATCH void add_product(const BatchValue& a, const BatchValue& b, BatchValue& c) {
  c = by_parts<BatchValue>(
      [](const BatchPart& x, const BatchPart& y, BatchPart z) {
        add_product(x, y, z);
        return z;
      },
      a, b, c);
}

/// c -= a b, in every lane.
POUNDING_BATCH void subtract_product(const BatchValue& a, const BatchValue& b, BatchValue& c) {
  add_product(-a, b, c);
}

POUNDING_BATCH BatchMask operator<(const BatchValue& a, const BatchValue& b) {
  return by_parts<BatchMask>([](const auto& x, const auto& y) { return x < y; }, a, b);
}
POUNDING_BATCH BatchMask operator<=(const BatchValue& a, const BatchValue& b) {
  return by_parts<BatchMask>([](const auto& x, const auto& y) { return x <= y; }, a, b);
}
POUNDING_BATCH BatchMask operator&(const BatchMask& a, const BatchMask& b) {
  return by_parts<BatchMask>([](const auto& x, const auto& y) { return x & y; }, a, b);
}
POUNDING_BATCH BatchMask operator|(const BatchMask& a, const BatchMask& b) {
  return by_parts<BatchMask>([](const auto& x, const auto& y) { return x | y; }, a, b);
}
POUNDING_BATCH bool any(const BatchMask& mask) {
  bool found = false;
  for (const BatchMaskPart& part : mask.parts) {
    for (std::size_t lane = 0; lane < batch_part_size; ++lane) found = found || part[lane] != 0;
  }
  return found;
}

/// Values of a where the mask is true, else of b.
POUNDING_BATCH BatchValue choose(const BatchMask& mask, const BatchValue& a, const BatchValue& b) {
  return by_parts<BatchValue>([](const BatchMaskPart& first, const BatchPart& x,
                                 const BatchPart& y) { return first ? x : y; },
                              mask, a, b);
}
POUNDING_BATCH BatchValue magnitude(const BatchValue& a) {
  return by_parts<BatchValue>([](const BatchPart& x) { return x < 0 ? -x : x; }, a);
}
POUNDING_BATCH BatchValue larger(const BatchValue& a, const BatchValue& b) {
  return choose(b < a, a, b);
}

/// The number of one of eight runs; a double is that of a run by itself.
POUNDING_BATCH double of_member(const BatchValue& value, std::size_t member) {
  return value[member];
}
POUNDING_BATCH double of_member(double value, std::size_t /*member*/) {
  return value;
}
POUNDING_BATCH void set_member(BatchValue& value, std::size_t member, double number) {
  value.set(member, number);
}
POUNDING_BATCH void set_member(double& value, std::size_t /*member*/, double number) {
  value = number;
}

#undef POUNDING_BATCH

}  // namespace pounding
