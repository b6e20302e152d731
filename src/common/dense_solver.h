#pragma once

#include <vector>

namespace pounding {

/// Solution of A x = b for a full matrix, shape (n, n) by rows, which is destroyed; `values`, shape
/// (n), holds b and receives x. False, and b lost, if A is singular. LAPACK dgesv.
bool solve_dense(std::vector<double>& matrix, std::vector<double>& values);

}  // namespace pounding
