#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mpi.h>

#include "common/crowded_node.h"

namespace pounding {

/// Values that ranks of a communicator show each other through common memory, turn after turn, with
/// less delay than messages. Only for ranks of one node.
///
///     exchange.publish(mine);
///     for each rank: read exchange.wait_for(rank)
///
/// In every turn a rank waits for all readers of its values, whether it reads theirs or not: its
/// published values then stay readable until those have published their next values.
class SharedExchange {
 public:
  /// `capacity`: values that this rank may write in a turn. Where the ranks have no memory in
  /// common, or the system gives none, works() is false on all of them. Collective.
  SharedExchange(MPI_Comm comm, std::size_t capacity);
  SharedExchange(const SharedExchange&) = delete;
  SharedExchange& operator=(const SharedExchange&) = delete;
  ~SharedExchange();

  bool works() const { return memory_ != nullptr; }

  /// Begins a turn: `values`, at most as many as the capacity, are copied.
  void publish(std::span<const double> values);
  /// Publishes in two steps: where the values of the next turn go, and that they are there.
  double* draft() const { return boards_[rank_].values[(turn_ + 1) % 2]; }
  void publish();
  /// Values that a rank published in this turn; waits until it has.
  const double* wait_for(int rank) const;

 private:
  /// Gives the processor to others for the n-th time in a wait.
  void give_way(int n) const;

  /// Part of the common memory that one rank writes.
  struct Board {
    std::atomic<std::uint64_t>* turn = nullptr;  ///< last one published
    double* values[2] = {nullptr, nullptr};      ///< of even and odd turns
  };

  MPI_Comm comm_;
  std::size_t rank_ = 0;
  std::vector<Board> boards_;  ///< per rank
  std::uint64_t turn_ = 0;
  int most_patience_ = 0;
  /// Looks before the processor is given to somebody else: few once that had to be done for long,
  /// more again after waits that were short.
  mutable int patience_ = 0;
  mutable NodeLoad load_;
  void* memory_ = nullptr;
  std::size_t memory_size_ = 0;
};

}  // namespace pounding
