#pragma once

#include <span>
#include <vector>

#include "interactions/contact_operator.h"
#include "interactions/interface_compliance.h"
#include "interactions/solvers/sparse_rows.h"

namespace pounding::interactions {

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

}  // namespace pounding::interactions
