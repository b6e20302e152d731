#include "common/parallel.h"

#include <chrono>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <thread>

#include "common/error.h"
#include "common/memory.h"

namespace pounding {
namespace {

enum class Failure : int { none = 0, user = 1, other = 2 };

/// Message of the exception that `work` threw, or nothing.
std::pair<Failure, std::string> failure_of(MPI_Comm comm, const std::function<void()>& work) {
  try {
    work();
  } catch (const UserError& error) {
    return {Failure::user, error.what()};
  } catch (const std::bad_alloc&) {
    return {Failure::user, out_of_memory(rank_of(comm))};
  } catch (const std::exception& error) {
    return {Failure::other, error.what()};
  }
  return {Failure::none, ""};
}

[[noreturn]] void raise(Failure failure, const std::string& message) {
  if (failure == Failure::user) throw UserError(message);
  throw std::runtime_error(message);
}

/// Ends a request; a wait of more than some microseconds leaves the processor to others, as Gmsh's
/// process while rank 0 waits for its mesh.
void wait_asleep(MPI_Request& request) {
  constexpr int quick_looks = 200;
  constexpr std::chrono::microseconds longest(1000);
  std::chrono::microseconds pause(20);
  for (int look = 0, done = 0;; ++look) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    if (look < quick_looks) continue;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, longest);
  }
}

}  // namespace

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

std::string out_of_memory(int rank) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "out of memory on rank %d, which has used %.2f GiB at most; take a smaller scene, a "
      "coarser mesh or a machine (or a limit) with more",
      rank, largest_memory() / (1 << 30));
  return text;
}

int size_of(MPI_Comm comm) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

void broadcast(MPI_Comm comm, std::string& text) {
  std::vector<char> bytes(text.begin(), text.end());
  broadcast_array(comm, bytes);
  text.assign(bytes.begin(), bytes.end());
}

void on_rank0(MPI_Comm comm, const std::function<void()>& work) {
  std::pair<Failure, std::string> outcome{Failure::none, ""};
  if (rank_of(comm) == 0) outcome = failure_of(comm, work);
  int kind = static_cast<int>(outcome.first);
  MPI_Request shared = MPI_REQUEST_NULL;
  MPI_Ibcast(&kind, 1, MPI_INT, 0, comm, &shared);
  wait_asleep(shared);
  if (kind != 0) {
    broadcast(comm, outcome.second);
    raise(static_cast<Failure>(kind), outcome.second);
  }
}

void on_every_rank(MPI_Comm comm, const std::function<void()>& work) {
  const auto [failure, message] = failure_of(comm, work);
  const int mine = failure == Failure::none ? size_of(comm) : rank_of(comm);
  int first = 0;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == size_of(comm)) return;
  int kind = static_cast<int>(failure);
  MPI_Bcast(&kind, 1, MPI_INT, first, comm);
  std::vector<char> bytes(message.begin(), message.end());
  broadcast_array(comm, bytes, first);
  raise(static_cast<Failure>(kind), std::string(bytes.begin(), bytes.end()));
}

void share_extreme(MPI_Comm comm, MPI_Op extreme, double& value, std::string& name) {
  struct {
    double value;
    int rank;
  } found{value, rank_of(comm)};
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_DOUBLE_INT, extreme, comm);
  value = found.value;
  broadcast_values(comm, found.rank, name);
}

}  // namespace pounding
