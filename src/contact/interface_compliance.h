#pragma once

#include <span>
#include <vector>

#include "contact/contact_operator.h"
#include "system/trace.h"

namespace pounding {

/// G = T M^-1 T^T [1/kg] over the interface's dofs, the same on every rank: velocities that
/// impulses at these dofs cause. Diagonal where a dof is one of the structure's own, a full block
/// for a structure whose dofs move all of its interface.
class InterfaceCompliance {
 public:
  /// `traces` per structure, over its dofs of the list in that order. Collective over `comm`.
  InterfaceCompliance(MPI_Comm comm, const std::vector<InterfaceDof>& dofs,
                      std::span<Trace> traces);

  double entry(std::size_t a, std::size_t b) const {
    if (a == b) return diagonal_[a];
    const int block = block_of_[a];
    return block < 0 || block != block_of_[b] ? 0 : blocks_[row_begin_[a] + place_[b]];
  }
  /// (G f)_a for impulses f over the interface's dofs.
  double velocity_change(std::size_t a, std::span<const double> f) const;
  /// Dofs with the same number here move together.
  int group_of(std::size_t a) const { return group_of_[a]; }

 private:
  std::vector<double> diagonal_;
  std::vector<int> block_of_;  ///< structure whose block the dof is in; -1: none
  std::vector<int> group_of_;
  std::vector<std::size_t> place_;      ///< within the structure
  std::vector<std::size_t> row_begin_;  ///< of the dof's row in blocks_
  std::vector<double> blocks_;
  std::vector<std::vector<int>> members_;  ///< per structure: its dofs
};

}  // namespace pounding
