#pragma once

#include <cstdio>

namespace pounding {

/// Name of vector instructions that this build uses and this machine has not; null if it has all.
/// Local.
inline const char* missing_vector_unit() {
  __builtin_cpu_init();
#ifdef __AVX512F__
  if (!__builtin_cpu_supports("avx512f")) return "AVX-512";
#endif
#ifdef __AVX2__
  if (!__builtin_cpu_supports("avx2")) return "AVX2";
#endif
#ifdef __FMA__
  if (!__builtin_cpu_supports("fma")) return "FMA";
#endif
  return nullptr;
}

/// Whether the program can run here; if not, a line says why. Asked before anything is computed: an
/// instruction that is not there kills a program without a word. Local.
inline bool fits_this_machine() {
  const char* const missing = missing_vector_unit();
  if (missing == nullptr) return true;
  std::fprintf(stderr,
               "pounding: built for machines with %s, which this one has not; build it on this "
               "one, or with -DPOUNDING_PORTABLE=ON\n",
               missing);
  return false;
}

}  // namespace pounding
