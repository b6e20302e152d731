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

void yield_while_waiting() {
  const char* const here = std::getenv(local_size);
  const char* const all = std::getenv("OMPI_COMM_WORLD_SIZE");
  const bool one_node = here != nullptr && all != nullptr && std::string(here) == all;
  if (one_node || crowded_node()) setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

bool NodeLoad::is_above_processors() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_look_) return above_;
  next_look_ = now + std::chrono::milliseconds(20);
  std::ifstream load("/proc/loadavg");
  double mean = 0;
  long running = 0;  // the fourth word begins with it: 3/120
  load >> mean >> mean >> mean >> running;
  above_ = load && running > sysconf(_SC_NPROCESSORS_ONLN);
  return above_;
}

}  // namespace pounding
