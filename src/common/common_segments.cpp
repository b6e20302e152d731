#include "common/common_segments.h"

#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>
#include <vector>

#include <mpi.h>

namespace pounding {
namespace {

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

}  // namespace pounding
