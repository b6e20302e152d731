#pragma once

#include <span>
#include <vector>

#include "interactions/contact_operator.h"
#include "solvers/sparse_rows.h"
#include "system/trace.h"

namespace pounding::interactions {

/// G = T M^-1 T^T [1/kg] over the interface's dofs, the same on every rank: velocities that
/// impulses at these dofs cause. Diagonal where a dof is one of the structure's own, more where the
/// mass of dofs is coupled, and a full block for a structure in generalised coordinates.
class InterfaceCompliance {
 public:
  /// `structure_dofs`: see dofs_by_structure; `traces` over these. Collective over `comm`.
  InterfaceCompliance(MPI_Comm comm, std::span<const std::vector<int>> structure_dofs,
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

/// Delassus operator H = L T M^-1 T^T L^T: the entry of two rows of L [1/kg], the same on every
/// rank.
double delassus_entry(const ContactOperator& contact, const InterfaceCompliance& compliance,
                      int row, int column);

/// Pattern of H: finds the rows of L that share something that moves with a row of it. Every rank
/// finds the same. Not collective.
class DelassusPattern {
 public:
  /// References must outlive this object.
  DelassusPattern(const ContactOperator& contact, const InterfaceCompliance& compliance);

  /// Rows of L coupled with any of `rows`, these included, ascending.
  std::vector<int> coupled_with(std::span<const int> rows);

 private:
  const ContactOperator& contact_;
  const InterfaceCompliance& compliance_;
  std::vector<std::vector<int>> rows_of_;  ///< per dof
  std::vector<char> seen_;                 ///< per dof
};

/// Splits the constraints into groups that share no dof: H = L M^-1 L^T couples rows of the same
/// group only, so each is a complementarity problem of its own, and a group of one row has the
/// closed form lambda = max(0, -b / H).
///
/// `row_dofs`: per row the dofs with a coefficient, each in [0, number_of_dofs), in any order. Dofs
/// without inverse mass couple nothing; leave them out. Returns the rows of each group, ascending;
/// groups in the order of their first row. Throws std::invalid_argument on a dof out of range.
std::vector<std::vector<int>> coupled_components(std::span<const std::vector<int>> row_dofs,
                                                 int number_of_dofs);

}  // namespace pounding::interactions
