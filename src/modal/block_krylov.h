#pragma once

#include <vector>

#include "common/dense_matrix.h"
#include "mesh/mesh.h"
#include "modal/shifted_solver.h"
#include "system/linear_system.h"

namespace pounding {

/// Eigenvalues, increasing, and a column over the owned dofs for each.
struct Eigenpairs {
  std::vector<double> values;
  DenseMatrix vectors;
};

/// Columns that the space of `lowest_eigenpairs` may have. A structure of fewer dofs is better
/// decomposed as a full matrix.
std::size_t largest_krylov_space(std::size_t count);

/// The lowest eigenpairs, `count` or more, of the matrix of a solver whose shift lies below all of
/// them, by a block Krylov space of (A - shift I)^-1:
///
///     (A - s I)^-1 V = V H + X R E^T,      V^T V = I,  V^T X = 0,  H symmetric
///
/// with X the next block, E the columns of the last one and Rayleigh-Ritz on V; |R E^T s_i| is the
/// residual of the Ritz pair (theta_i, V s_i), 1e-10 of theta_i in the end. A space that has grown
/// too large is cut down to its best Ritz vectors, which keeps the relation (Krylov-Schur, Stewart,
/// SIAM J. Matrix Anal. Appl. 23 (2002) 601, in blocks: Zhou and Saad, Numer. Algorithms 47 (2008)
/// 341). A block of right-hand sides takes the factor out of the memory once, and a block sees as
/// many equal eigenvalues as it has columns: where it has found so many, the law of inertia counts
/// those that there are, and another block seeks the rest. Start blocks are the same for any number
/// of ranks.
/// SLEPc's Krylov-Schur, one vector at a time, took 190 s in place of 58 s for 400 modes of 115,362
/// dofs (docs/measurements/performance.md); few modes are left to it (`lowest_modes`).
/// Throws UserError where fewer converge. Collective.
Eigenpairs lowest_eigenpairs(const LinearSystem& system, const Mesh& mesh,
                             const ShiftedSolver& solver, std::size_t count);

}  // namespace pounding
