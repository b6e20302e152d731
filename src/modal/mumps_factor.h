#pragma once

#include <cstddef>
#include <memory>

#include "common/petsc.h"

namespace pounding {

/// Factor L D L^T of a symmetric matrix less a shift, by MUMPS (Amestoy, Duff, L'Excellent and
/// Koster, SIAM J. Matrix Anal. Appl. 23 (2001) 15) without PETSc between: on several ranks PETSc
/// builds the exchange of the solution anew for each block of right-hand sides, which took half of
/// the time of a large basis (docs/measurements/performance.md). The options
/// -lowest_st_mat_mumps_icntl_* hold as they do with PETSc.
class MumpsFactor {
 public:
  /// A - shift I of an AIJ matrix, both of whose triangles are there; it is not kept. Throws
  /// std::bad_alloc without memory for the factor and std::runtime_error with the status of MUMPS
  /// where it fails otherwise, on every rank alike. Collective.
  MumpsFactor(Mat matrix, double shift);

  /// X := (A - shift I)^-1 X of so many columns over the rows that this rank owns. Throws
  /// std::runtime_error where A - shift I is singular. Collective.
  void solve(double* x, std::size_t columns) const;
  /// Number of negative pivots, which is that of eigenvalues of A below the shift (Sylvester's law
  /// of inertia).
  int negative_pivots() const;

 private:
  class Instance;
  std::shared_ptr<Instance> instance_;
};

}  // namespace pounding
