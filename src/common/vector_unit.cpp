#include "common/vector_unit.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>

#include "common/error.h"

#ifdef POUNDING_JOINED_UNITS
// Symbols that cmake/join_units.py defines: functions in use, their number, and tables of the units
// in the order of POUNDING_UNITS.
extern "C" {
extern void* pounding_kernels[];
extern const std::size_t pounding_kernel_count;
extern void* const* const pounding_kernel_tables[];
}
#endif

namespace pounding {
namespace {

constexpr const char* names[] = {POUNDING_UNITS};

/// Whether this machine has a unit.
bool is_here(std::string_view name) {
#ifdef __x86_64__
  __builtin_cpu_init();
  if (name == "v4") return __builtin_cpu_supports("x86-64-v4");
  if (name == "v3") return __builtin_cpu_supports("x86-64-v3");
  if (name == "v2") return __builtin_cpu_supports("x86-64-v2");
#endif
  return name == "generic";
}

/// The number of the best unit of this machine; that of the least, if it has none.
std::size_t best_unit() {
  std::size_t unit = std::size(names) - 1;
  while (unit > 0 && !is_here(names[unit])) --unit;
  return unit;
}

std::size_t unit_in_use = 0;

/// Names of the units in one text.
std::string compiled() {
  std::string text;
  for (const char* name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

/// The smallest value of all ranks. Collective.
std::size_t least(MPI_Comm comm, std::size_t value) {
  std::uint64_t smallest = value;
  MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_UINT64_T, MPI_MIN, comm);
  return smallest;
}

}  // namespace

std::size_t unit_number() {
  return unit_in_use;
}

void use_unit_number(std::size_t unit) {
  unit_in_use = unit;
#ifdef POUNDING_JOINED_UNITS
  std::copy_n(pounding_kernel_tables[unit], pounding_kernel_count, pounding_kernels);
#endif
}

std::vector<std::string> compiled_vector_units() {
  return {std::begin(names), std::end(names)};
}

std::string vector_unit() {
  return names[unit_in_use];
}

void use_vector_unit(MPI_Comm comm, std::string_view name) {
  const std::size_t common = least(comm, best_unit());
  if (name == "auto") return use_unit_number(common);
  const auto* const found = std::ranges::find(names, name);
  const auto unit = static_cast<std::size_t>(found - std::begin(names));
  refuse_if(found == std::end(names), "option -vector_unit " + std::string(name) +
                                          ": the program was built for " + compiled() +
                                          "; -DPOUNDING_VECTOR_UNITS=all builds it for all units");
  if (unit <= common) return use_unit_number(unit);
  throw UserError("option -vector_unit " + std::string(name) +
                  ": the best that program and machine have is " + names[common]);
}

}  // namespace pounding

/// Uses the best unit before any other object of the program is made, which might call a kernel.
extern "C" [[gnu::constructor(101)]] void pounding_use_best_unit() {
  if (!pounding::is_here(pounding::names[0])) {
    std::fprintf(stderr,
                 "pounding: built for machines with %s, which this one has not; build it on this "
                 "one, with another -DPOUNDING_VECTOR_UNITS\n",
                 pounding::names[0]);
    std::_Exit(1);
  }
  pounding::use_unit_number(pounding::best_unit());
}
