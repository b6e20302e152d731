#include "benchmark/command_loop.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <unistd.h>

namespace pounding::measuring {
namespace {

constexpr int command_tag = 7;
constexpr const char* last_command = "end";

int rank_in(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

std::string read_and_send(MPI_Comm comm) {
  std::string line;
  if (!std::getline(std::cin, line)) {
    line = last_command;
  }
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  for (int rank = 1; rank < ranks; ++rank) {
    MPI_Send(line.data(), static_cast<int>(line.size()), MPI_CHAR, rank, command_tag, comm);
  }
  return line;
}

/// A blocking receive would spin; this one sleeps.
std::string receive(MPI_Comm comm) {
  constexpr unsigned pause = 2000;  // [microseconds]
  MPI_Status status;
  int here = 0;
  for (MPI_Iprobe(0, command_tag, comm, &here, &status); here == 0;
       MPI_Iprobe(0, command_tag, comm, &here, &status)) {
    usleep(pause);
  }
  int length = 0;
  MPI_Get_count(&status, MPI_CHAR, &length);
  std::string line(static_cast<std::size_t>(length), ' ');
  MPI_Recv(line.data(), length, MPI_CHAR, 0, command_tag, comm, MPI_STATUS_IGNORE);
  return line;
}

}  // namespace

void answer(MPI_Comm comm, const Json& json) {
  if (rank_in(comm) == 0) {
    std::printf("%s\n", json.dump().c_str());
    std::fflush(stdout);
  }
}

void serve(MPI_Comm comm, const std::function<Json(const std::string&)>& measure) {
  const auto next = [comm] { return rank_in(comm) == 0 ? read_and_send(comm) : receive(comm); };
  for (std::string line = next(); line != last_command; line = next()) {
    answer(comm, measure(line));
  }
}

double time_of(MPI_Comm comm, const std::function<void()>& work) {
  MPI_Barrier(comm);
  const double start = MPI_Wtime();
  work();
  double seconds = MPI_Wtime() - start;
  MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, comm);
  return seconds;
}

long repetitions(MPI_Comm comm, double seconds, double once) {
  long count = static_cast<long>(std::clamp(seconds / std::max(once, 1e-9), 1.0, 1e9));
  MPI_Bcast(&count, 1, MPI_LONG, 0, comm);
  return count;
}

}  // namespace pounding::measuring
