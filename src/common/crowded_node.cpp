#include "common/crowded_node.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <unistd.h>
#include <vector>

#include <mpi.h>

namespace pounding {
namespace {

constexpr const char* local_size = "OMPI_COMM_WORLD_LOCAL_SIZE";

/// Variables of launchers and of batch systems: without any, a process is a rank of its own.
constexpr auto launchers =
    std::to_array<const char*>({local_size, "PMIX_NAMESPACE", "PMI_RANK", "PMI_FD", "SLURM_JOB_ID",
                                "PBS_JOBID", "LSB_JOBID", "PE_HOSTFILE", "FLUX_JOB_ID"});

/// Whether Open MPI's launcher started all ranks on this node.
bool is_one_node() {
  const char* const here = std::getenv(local_size);
  const char* const all = std::getenv("OMPI_COMM_WORLD_SIZE");
  return here != nullptr && all != nullptr && std::string(here) == all;
}

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

/// Files are found at the first message between two ranks. Both ways, so that nobody is early.
void greet_everybody(int ranks, int rank) {
  for (int round = 0; round < 2; ++round) {
    std::vector<int> got(ranks);
    std::vector<MPI_Request> requests(2 * got.size());
    for (int other = 0; other < ranks; ++other) {
      const std::size_t i = other;
      MPI_Irecv(&got[i], 1, MPI_INT, other, round, MPI_COMM_WORLD, &requests[2 * i]);
      MPI_Isend(&rank, 1, MPI_INT, other, round, MPI_COMM_WORLD, &requests[2 * i + 1]);
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

/// The file that Open MPI made for this rank, among those that are mapped: vader_segment.*.R in
/// release 4, sm_segment.*.R in 5, R the rank among those of this machine. Empty: there is none.
std::string own_segment() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_LOCAL_RANK");
  if (rank == nullptr) return "";
  const std::string end = std::string(".") + rank;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t name = line.rfind('/') + 1;
    const bool segment =
        line.compare(name, 14, "vader_segment.") == 0 || line.compare(name, 11, "sm_segment.") == 0;
    if (segment && line.ends_with(end)) return line.substr(line.find('/'));
  }
  return "";
}

}  // namespace

bool crowded_node() {
  const char* const ranks = std::getenv(local_size);
  return ranks != nullptr && std::strtol(ranks, nullptr, 10) > processors();
}

void yield_while_waiting() {
  if (is_one_node() || crowded_node()) setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

void listen_nowhere() {
  const bool alone = std::ranges::none_of(
      launchers, [](const char* name) { return std::getenv(name) != nullptr; });
  if (!alone && !is_one_node()) return;
  char release[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(release, &length);  // may be called before MPI_Init
  const bool fourth = std::string(release).starts_with("Open MPI v4");
  setenv("OMPI_MCA_btl", fourth ? "self,vader" : "self,sm", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);  // others have networks of their own
  // A rank without mpirun would start a daemon, which listens; release 5 has none.
  if (alone) setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
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

NamelessSegments::NamelessSegments() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return;
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  greet_everybody(ranks, rank);
  const std::string segment = own_segment();
  if (!segment.empty() && unlink(segment.c_str()) == 0) path_ = segment;
}

NamelessSegments::~NamelessSegments() {
  if (!path_.empty()) close(open(path_.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
}

pid_t parent_of(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    if (word == "PPid:") {
      pid_t parent = 0;
      status >> parent;
      return parent;
    }
  }
  return 0;
}

}  // namespace pounding
