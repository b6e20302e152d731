#pragma once

#include <vector>

#include "common/dense_matrix.h"

namespace pounding {

/// Makes the first `count` columns upper triangular by reflections (Householder), in place; the
/// other columns are reflected with them.
void triangularize(DenseMatrix& matrix, std::size_t count);

/// The x >= 0 that makes |A x - b| least, shape (columns): C. L. Lawson and R. J. Hanson, *Solving
/// Least Squares Problems* (1974), chapter 23. `b`: shape (rows).
std::vector<double> nonnegative_solution(const DenseMatrix& a, const std::vector<double>& b);

}  // namespace pounding
