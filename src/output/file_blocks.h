#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace pounding {

/// The nodes of a structure in file order, cut into one block of consecutive nodes per rank, and
/// the way of values between these ranks and those that own the nodes. A rank writes and reads its
/// block of a file in one piece. No rank holds more than its share.
class FileBlocks {
 public:
  /// Collective.
  explicit FileBlocks(const Mesh& mesh);

  GlobalIndex first() const { return first_; }          ///< node of this rank's block
  std::size_t count() const { return places_.size(); }  ///< nodes of this rank's block
  /// Rows of `columns` values per owned node, shape (owned_nodes, columns), to those per node of
  /// this rank's block. Collective; allocates nothing when called again with as many columns.
  void to_file(std::span<const double> owned, std::size_t columns, std::span<double> block);
  /// The way back. Collective.
  void to_owners(std::span<const double> block, std::size_t columns, std::span<double> owned);

 private:
  MPI_Comm comm_;
  GlobalIndex first_ = 0;
  std::vector<LocalIndex> order_;    ///< owned nodes in file order
  std::vector<std::size_t> places_;  ///< in this rank's block, of the nodes as they arrive
  std::vector<int> send_counts_, send_offsets_;        ///< nodes to each rank
  std::vector<int> receive_counts_, receive_offsets_;  ///< nodes from each rank
  std::vector<double> of_owned_, of_block_;            ///< rows on their way, in its order
};

}  // namespace pounding
