#pragma once

#include <span>
#include <vector>

namespace pounding::interactions {

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
