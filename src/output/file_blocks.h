#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace pounding {

/// The nodes of a structure in file order, cut into one block of consecutive nodes per rank, and
/// the way there of values from the ranks that own the nodes. A rank writes its block of a file in
/// one piece. Constant after construction.
class FileBlocks {
 public:
  /// Collective.
  explicit FileBlocks(const Mesh& mesh);

  GlobalIndex first() const { return first_; }          ///< node of this rank's block
  std::size_t count() const { return places_.size(); }  ///< nodes of this rank's block
  /// Three values per owned node, shape (owned_nodes, 3), to three per node of this rank's block.
  /// Collective; allocates nothing.
  void exchange(std::span<const double> owned, std::span<double> block);

 private:
  MPI_Comm comm_;
  GlobalIndex first_ = 0;
  std::vector<LocalIndex> order_;    ///< owned nodes in file order
  std::vector<std::size_t> places_;  ///< in this rank's block, of the nodes as they arrive
  std::vector<int> send_counts_, send_offsets_;        ///< values to each rank
  std::vector<int> receive_counts_, receive_offsets_;  ///< values from each rank
  std::vector<double> sent_, received_;
};

}  // namespace pounding
