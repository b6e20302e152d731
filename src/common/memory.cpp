#include "common/memory.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#ifdef __GLIBC__
#endif
#ifdef __linux__
#endif
namespace pounding {
namespace {

constexpr double kibibyte = 1024;  // the kernel counts in it [bytes]

/// Largest of the peaks that were begun anew [bytes].
double largest_before = 0;

double most_resident(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return kibibyte * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

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

#ifdef __linux__

namespace {

/// Advice on whole pages of so many bytes.
void advise(void* bytes, std::size_t count, std::uintptr_t page, int advice) {
  const auto begin = reinterpret_cast<std::uintptr_t>(bytes);
  const std::uintptr_t first = (begin + page - 1) / page * page;
  const std::uintptr_t end = (begin + count) / page * page;
  if (end > first) madvise(static_cast<char*>(bytes) + (first - begin), end - first, advice);
}

}  // namespace

void wish_large_pages(void* bytes, std::size_t count) {
  advise(bytes, count, LargePageAllocator<double>::page, MADV_HUGEPAGE);
}

void return_pages(void* bytes, std::size_t count) {
  advise(bytes, count, static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE)), MADV_DONTNEED);
}

#else

void wish_large_pages(void* /*bytes*/, std::size_t /*count*/) {}
void return_pages(void* /*bytes*/, std::size_t /*count*/) {}

#endif

MemoryUse take_memory_use() {
  MemoryUse use;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double* const value = word == "VmHWM:" ? &use.peak : word == "VmRSS:" ? &use.held : nullptr;
    if (value != nullptr && status >> *value) *value *= kibibyte;
  }
  use.peak = std::max(use.peak, use.held);
  largest_before = std::max(largest_before, use.peak);
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
  return use;
}

double largest_memory() {
  return std::max(largest_before, most_resident(RUSAGE_SELF));
}

double largest_memory_of_children() {
  return most_resident(RUSAGE_CHILDREN);
}

}  // namespace pounding
