#include "common/crowded_node.h"

#include <cstdlib>
#include <sched.h>
#include <thread>

namespace pounding {
namespace {

/// Value of a variable that holds a number; 0 if there is none.
long number_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr ? std::strtol(value, nullptr, 10) : 0;
}

/// Processors that the ranks of this node have together.
long processors() {
  const bool own = number_of("OMPI_MCA_orte_bound_at_launch") != 0;
  cpu_set_t mine;
  CPU_ZERO(&mine);
  if (!own && sched_getaffinity(0, sizeof mine, &mine) == 0) return CPU_COUNT(&mine);
  return static_cast<long>(std::thread::hardware_concurrency());
}

}  // namespace

bool crowded_node() {
  return number_of("OMPI_COMM_WORLD_LOCAL_SIZE") > processors();
}

void yield_where_crowded() {
  if (crowded_node()) setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

}  // namespace pounding
