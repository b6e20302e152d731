#pragma once

#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "common/shared_exchange.h"

namespace pounding::interactions {

/// Brings the values of all interface dofs to every rank that knows one. Those ranks form a
/// communicator of their own; the others never take part. Since values travel, not partial sums,
/// results from them do not depend on the partition. On one node they travel through common memory,
/// else in messages.
class InterfaceGather {
 public:
  /// `mine`: interface dofs whose values this rank knows, in the order of its values; each is known
  /// to one rank. `common_memory`: false to send messages even within a node. Collective over
  /// `comm`.
  InterfaceGather(MPI_Comm comm, std::span<const int> mine, bool common_memory = true);
  InterfaceGather(const InterfaceGather&) = delete;
  InterfaceGather& operator=(const InterfaceGather&) = delete;
  ~InterfaceGather();

  bool member() const { return comm_ != MPI_COMM_NULL; }
  /// The lowest member, in ranks of the communicator given.
  int root() const { return root_; }
  int members() const { return members_; }

  /// Gathers `fields` values per known dof. `mine`: shape (known, fields); `all`: shape
  /// (fields, interface dofs). Collective over the members. Allocates nothing.
  void gather(int fields, std::span<const double> mine, std::span<double> all);

  /// Sums over the members, in place. Collective over them.
  void add(std::span<double> values);

  static constexpr int max_fields = 2;

 private:
  void spread(int fields, std::size_t first, std::size_t end, const double* values,
              std::span<double> all) const;

  std::unique_ptr<SharedExchange> shared_;  ///< null: messages
  MPI_Comm comm_ = MPI_COMM_NULL;
  int root_ = 0;
  int members_ = 0;
  std::vector<int> counts_;   ///< dofs per member
  std::vector<int> order_;    ///< interface dof of each gathered one
  std::vector<int> lengths_;  ///< values per member in the current gather
  std::vector<int> offsets_;
  std::vector<double> buffer_;
};

}  // namespace pounding::interactions
