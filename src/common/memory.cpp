#include "common/memory.h"

#include <fstream>
#include <limits>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <cstdint>
#include <sys/mman.h>
#endif

namespace pounding {

#ifdef __GLIBC__

void return_large_arrays() {
  constexpr int large = 1 << 18;      // [B]; setting it keeps it from growing
  constexpr int most_arrays = 65536;  // the C library's own default, which MPI may have set to 0
  mallopt(M_MMAP_THRESHOLD, large);
  mallopt(M_MMAP_MAX, most_arrays);
}

void return_freed_memory() {
  malloc_trim(0);
}

void share_memory_among_threads() {
  mallopt(M_ARENA_MAX, 1);
}

#else

void return_large_arrays() {}
void return_freed_memory() {}
void share_memory_among_threads() {}

#endif

double available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    double kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<double> zeros_on_large_pages(std::size_t size) {
  std::vector<double> zeros;
  zeros.reserve(size);
#ifdef __linux__
  constexpr std::uintptr_t large_page = 1 << 21;  // [B]
  const auto begin = reinterpret_cast<std::uintptr_t>(zeros.data());
  const std::uintptr_t first = (begin + large_page - 1) / large_page * large_page;
  const std::uintptr_t end = (begin + size * sizeof(double)) / large_page * large_page;
  if (end > first) {
    // A wish: ordinary pages do as well.
    char* const bytes = reinterpret_cast<char*>(zeros.data());
    madvise(bytes + (first - begin), end - first, MADV_HUGEPAGE);
  }
#endif
  zeros.resize(size, 0.0);
  return zeros;
}

}  // namespace pounding
