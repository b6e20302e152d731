#pragma once

#include <span>
#include <vector>

#include <mpi.h>

#include "contact/contact_operator.h"

namespace pounding {

/// Brings the values of all interface dofs to every rank that owns one. Those ranks form a
/// communicator of their own; the others never take part. Since values travel, not partial sums,
/// what is computed from them does not depend on the partition.
class InterfaceGather {
 public:
  /// Collective over `comm`.
  InterfaceGather(MPI_Comm comm, const ContactOperator& contact_operator,
                  std::span<const Mesh> meshes);
  InterfaceGather(const InterfaceGather&) = delete;
  InterfaceGather& operator=(const InterfaceGather&) = delete;
  ~InterfaceGather();

  /// One interface dof that this rank owns.
  struct Owned {
    int structure = 0;
    LocalIndex dof = 0;  ///< local dof of that structure
    int interface_dof = 0;
  };

  bool member() const { return comm_ != MPI_COMM_NULL; }
  /// The lowest member, in ranks of the communicator given.
  int root() const { return root_; }
  int members() const { return members_; }
  const std::vector<Owned>& owned() const { return owned_; }

  /// Gathers `fields` values per owned dof. `mine`: shape (owned, fields); `all`: shape
  /// (fields, interface dofs). Collective over the members. Allocates nothing.
  void gather(int fields, std::span<const double> mine, std::span<double> all);

  static constexpr int max_fields = 3;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  int root_ = 0;
  int members_ = 0;
  std::vector<Owned> owned_;
  std::vector<int> counts_;   ///< dofs per member
  std::vector<int> order_;    ///< interface dof of each gathered one
  std::vector<int> lengths_;  ///< values per member in the current gather
  std::vector<int> offsets_;
  std::vector<double> buffer_;
};

}  // namespace pounding
