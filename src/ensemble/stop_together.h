#pragma once

#include <algorithm>
#include <vector>

#include <mpi.h>

#include "common/parallel.h"
#include "driver/time_loop.h"

namespace pounding {

/// Spreads a signal that one rank received to ranks that work without each other. They ask now and
/// then; nobody waits for anybody until `finish`.
class StopTogether {
 public:
  explicit StopTogether(MPI_Comm comm) : comm_(comm), heard_(size_of(comm), 0) {}
  StopTogether(const StopTogether&) = delete;
  StopTogether& operator=(const StopTogether&) = delete;

  /// Whether to stop: this rank or another one received a signal. Local.
  bool ask() {
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
  /// The signal of all ranks, 0 if there was none. Collective.
  int finish() {
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

 private:
  static constexpr int tag = 7;

  void receive(int from) {
    int signal = 0;
    MPI_Recv(&signal, 1, MPI_INT, from, tag, comm_, MPI_STATUS_IGNORE);
    heard_[from] = 1;
    signal_ = std::max(signal_, signal);
  }

  MPI_Comm comm_;
  int signal_ = 0;
  bool told_ = false;
  std::vector<MPI_Request> sent_;
  std::vector<char> heard_;  ///< per rank
};

}  // namespace pounding
