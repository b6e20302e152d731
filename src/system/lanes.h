#pragma once

#include <cstdint>
#include <cstring>

/// Four doubles at once, by the compiler's vector types: AVX where the build allows it, two SSE
/// halves elsewhere.
namespace pounding {

using Lanes = double __attribute__((vector_size(32)));
using LaneMask = std::int64_t __attribute__((vector_size(32)));
using HalfLanes = double __attribute__((vector_size(16)));

static inline __attribute__((always_inline)) void load(const double* from, Lanes& to) {
  std::memcpy(&to, from, sizeof to);
}
static inline __attribute__((always_inline)) void store(double* to, const Lanes& from) {
  std::memcpy(to, &from, sizeof from);
}

}  // namespace pounding
