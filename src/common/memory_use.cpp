#include "common/memory_use.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <sys/resource.h>

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
