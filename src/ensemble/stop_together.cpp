#include "ensemble/stop_together.h"

#include <algorithm>

#include "common/parallel.h"
#include "driver/time_loop.h"

namespace pounding {
namespace {

constexpr int tag = 7;

}  // namespace

StopTogether::StopTogether(MPI_Comm comm) : comm_(comm), heard_(size_of(comm), 0) {}

void StopTogether::receive(int from) {
  int signal = 0;
  MPI_Recv(&signal, 1, MPI_INT, from, tag, comm_, MPI_STATUS_IGNORE);
  heard_[from] = 1;
  signal_ = std::max(signal_, signal);
}

bool StopTogether::ask() {
  int waiting = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag, comm_, &waiting, &status);
  if (waiting != 0) receive(status.MPI_SOURCE);
  if (!told_ && StopSignal::received() != 0) {
    told_ = true;
    signal_ = StopSignal::received();
    for (int rank = 0; rank < size_of(comm_); ++rank) {
      if (rank == rank_of(comm_)) continue;
      MPI_Isend(&signal_, 1, MPI_INT, rank, tag, comm_, &sent_.emplace_back());
    }
  }
  return signal_ != 0;
}

int StopTogether::finish() {
  std::vector<char> tellers(heard_.size(), 0);
  const char mine = told_ ? 1 : 0;
  MPI_Allgather(&mine, 1, MPI_CHAR, tellers.data(), 1, MPI_CHAR, comm_);
  for (std::size_t rank = 0; rank < tellers.size(); ++rank) {
    const bool own = static_cast<int>(rank) == rank_of(comm_);
    if (tellers[rank] != 0 && heard_[rank] == 0 && !own) receive(static_cast<int>(rank));
  }
  MPI_Waitall(static_cast<int>(sent_.size()), sent_.data(), MPI_STATUSES_IGNORE);
  return signal_;
}

}  // namespace pounding
