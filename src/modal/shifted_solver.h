#pragma once

#include <vector>

#include "common/dense_matrix.h"
#include "common/petsc.h"
#include "modal/mumps_factor.h"

namespace pounding {

/// Factorisation L D L^T (MUMPS) of a symmetric matrix less a shift, for many right-hand sides.
class ShiftedSolver {
 public:
  /// Keeps a reference to the matrix. Throws as MumpsFactor does. Collective over the matrix'
  /// communicator.
  ShiftedSolver(Mat matrix, double shift);

  /// x := (A - shift I)^-1 x over the owned dofs. Collective.
  void solve(std::vector<double>& x) const;
  /// X := (A - shift I)^-1 X of columns over the owned dofs. Collective.
  void solve(DenseMatrix& x) const;
  double shift() const { return shift_; }
  /// Number of eigenvalues of A below the shift (Sylvester's law of inertia). Collective.
  int eigenvalues_below() const;
  /// Number of them below a value, by another factorisation. Collective.
  int eigenvalues_below(double value) const;

 private:
  MatHandle matrix_;
  double shift_;
  MumpsFactor factor_;
};

}  // namespace pounding
