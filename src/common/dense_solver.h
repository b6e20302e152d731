#pragma once

#include <span>
#include <vector>

namespace pounding {

/// Makes the BLAS take the memory that it works in. OpenBLAS asks for 128 MB of addresses at its
/// first product and, where a limit refuses them, for ever again. Throws std::bad_alloc in place of
/// that.
void take_blas_memory();

/// Solution of A x = b for a full matrix, shape (n, n) by rows, which is destroyed; `values`, shape
/// (n), holds b and receives x. False, and b lost, if A is singular. LAPACK dgesv.
bool solve_dense(std::vector<double>& matrix, std::vector<double>& values);

/// Solution of A x = b without allocation: `pivots`, shape (n), is scratch.
bool solve_dense(std::span<double> matrix, std::span<double> values, std::span<int> pivots);

/// Inverse of a symmetric positive definite matrix, shape (n, n), in its place, symmetric to the
/// last bit. False, and the matrix lost, if it is not definite. LAPACK dpotrf, dpotri.
bool invert_definite(std::vector<double>& matrix);

}  // namespace pounding
