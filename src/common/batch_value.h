#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "common/lanes.h"

/// Eight doubles at once, one for each of eight members of an ensemble: one register of AVX-512,
/// two of AVX, four of SSE2. Every operation is done lane by lane and rounded like that of a single
/// double (add_product in lanes.h), so that no lane depends on its neighbours. Type and alignment
/// are the same for every vector unit: code of all of them reads the same arrays.
namespace pounding {

/// Members that are stepped together.
inline constexpr std::size_t batch_size = 8;

struct alignas(64) BatchValue {
  double values[batch_size];

  double operator[](std::size_t lane) const { return values[lane]; }
  double& operator[](std::size_t lane) { return values[lane]; }
};

/// Lanes for which something is true.
struct alignas(64) BatchMask {
  std::int64_t values[batch_size];
};

#define POUNDING_BATCH static inline __attribute__((always_inline))

/// Lanes that one register holds: the compiler keeps vectors wider than that in memory.
#if defined(__AVX512F__)
using BatchPart = EightLanes;
#elif defined(__AVX__)
using BatchPart = Lanes;
#else
using BatchPart = HalfLanes;
#endif

constexpr std::size_t batch_parts = sizeof(BatchValue) / sizeof(BatchPart);

/// Part of lanes in memory. A copy of bytes would do the same, but keeps sums in memory.
template <typename Batch>
POUNDING_BATCH auto& part_of(Batch& batch, std::size_t p) {
  using Lane = std::remove_reference_t<decltype(batch.values[0])>;
  typedef Lane __attribute__((vector_size(sizeof(BatchPart)), may_alias)) Part;
  return reinterpret_cast<Part*>(batch.values)[p];
}

/// Part by part, each written out, so that all stay in registers.
template <typename Result, typename Operation, typename... Operands>
POUNDING_BATCH Result by_parts(const Operation& operation, const Operands&... operands) {
  Result result;
  const auto put = [&](std::size_t p) __attribute__((always_inline)) {
    part_of(result, p) = operation(part_of(operands, p)...);
  };
  put(0);
  if constexpr (batch_parts > 1) put(1);
  if constexpr (batch_parts > 2) put(2), put(3);
  return result;
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
POUNDING_BATCH BatchValue operator*(const BatchValue& a, double b) {
  return by_parts<BatchValue>([b](const auto& x) { return x * b; }, a);
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
  for (const std::int64_t lane : mask.values) found = found || lane != 0;
  return found;
}

/// Values of a where the mask is true, else of b.
POUNDING_BATCH BatchValue choose(const BatchMask& mask, const BatchValue& a, const BatchValue& b) {
  return by_parts<BatchValue>(
      [](const auto& first, const BatchPart& x, const BatchPart& y) { return first ? x : y; }, mask,
      a, b);
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
  value[member] = number;
}
POUNDING_BATCH void set_member(double& value, std::size_t /*member*/, double number) {
  value = number;
}

#undef POUNDING_BATCH

}  // namespace pounding
