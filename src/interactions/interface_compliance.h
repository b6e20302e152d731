#pragma once

#include <span>
#include <vector>

#include "interactions/contact_operator.h"
#include "interactions/solvers/sparse_rows.h"
#include "system/trace.h"

namespace pounding::interactions {

/// G = T M^-1 T^T [1/kg] over the interface's dofs, the same on every rank: velocities that
/// impulses at these dofs cause. Diagonal where a dof is one of the structure's own, more where the
/// mass of dofs is coupled, and a full block for a structure in generalised coordinates.
class InterfaceCompliance {
 public:
  /// `traces` per structure, over its dofs of the list in that order. Collective over `comm`.
  InterfaceCompliance(MPI_Comm comm, const std::vector<InterfaceDof>& dofs,
                      std::span<Trace> traces);

  double entry(std::size_t a, std::size_t b) const {
    return a == b ? diagonal_[a] : others_.entry(a, static_cast<int>(b));
  }
  /// (G f)_a for impulses f over the interface's dofs.
  double velocity_change(std::size_t a, std::span<const double> f) const;
  /// Dofs with the same number here move together.
  int group_of(std::size_t a) const { return group_of_[a]; }
  /// Dofs besides `a` that an impulse at `a` moves.
  std::span<const int> moved_by(std::size_t a) const { return others_.columns(a); }

 private:
  void find_groups();

  std::vector<double> diagonal_;
  SparseRows others_;  ///< G; of a dof that moves alone nothing
  std::vector<int> group_of_;
};

}  // namespace pounding::interactions
