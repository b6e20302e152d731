#include "common/crowded_node.h"

#include <cstdlib>
#include <fstream>
#include <sched.h>
#include <string>
#include <unistd.h>

#include "common/parent_process.h"

namespace pounding {
namespace {

constexpr const char* local_size = "OMPI_COMM_WORLD_LOCAL_SIZE";

/// Whether a process was started as one of the ranks, or by one: with the variable of ranks.
bool is_of_a_rank(pid_t process) {
  std::ifstream variables("/proc/" + std::to_string(process) + "/environ");
  const std::string wanted = std::string(local_size) + "=";
  for (std::string variable; std::getline(variables, variable, '\0');) {
    if (variable.starts_with(wanted)) return true;
  }
  return false;
}

/// Processors that the ranks of this node have together: those of the launcher, which is beyond
/// scripts between it and the program.
long processors() {
  pid_t launcher = getppid();
  while (launcher > 0 && is_of_a_rank(launcher)) launcher = parent_of(launcher);
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(launcher, sizeof set, &set) != 0) return sysconf(_SC_NPROCESSORS_ONLN);
  return CPU_COUNT(&set);
}

}  // namespace

bool crowded_node() {
  const char* const ranks = std::getenv(local_size);
  return ranks != nullptr && std::strtol(ranks, nullptr, 10) > processors();
}

void yield_where_crowded() {
  if (crowded_node()) setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

}  // namespace pounding
