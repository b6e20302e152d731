#pragma once

#include <vector>

#include <mpi.h>

namespace pounding {

/// Spreads a signal that one rank received to ranks that work without each other. They ask now and
/// then; nobody waits for anybody until `finish`.
class StopTogether {
 public:
  explicit StopTogether(MPI_Comm comm);
  StopTogether(const StopTogether&) = delete;
  StopTogether& operator=(const StopTogether&) = delete;

  /// Whether to stop: this rank or another one received a signal. Local.
  bool ask();
  /// The signal of all ranks, 0 if there was none. Collective.
  int finish();

 private:
  void receive(int from);

  MPI_Comm comm_;
  int signal_ = 0;
  bool told_ = false;
  std::vector<MPI_Request> sent_;
  std::vector<char> heard_;  ///< per rank
};

}  // namespace pounding
