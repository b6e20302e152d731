#pragma once

#include <vector>

#include "common/dense_matrix.h"
#include "common/petsc.h"
#include "mesh/mesh.h"
#include "modal/mumps_factor.h"
#include "scene/scene.h"
#include "system/element_forces.h"
#include "system/linear_system.h"

namespace pounding {

/// Factorisation L D L^T (MUMPS) of a symmetric matrix less a shift, for many right-hand sides.
class ShiftedSolver {
 public:
  /// Keeps a reference to the matrix. Throws as MumpsFactor does. Collective over the matrix'
  /// communicator.
  ShiftedSolver(Mat matrix, double shift);

  /// x := (A - shift I)^-1 x over the owned dofs. Collective.
  void solve(std::vector<double>& x) const { factor_.solve(x.data(), 1); }
  /// X := (A - shift I)^-1 X of columns over the owned dofs. Collective.
  void solve(DenseMatrix& x) const { factor_.solve(x.values.data(), x.columns); }
  double shift() const { return shift_; }
  /// Number of eigenvalues of A below the shift (Sylvester's law of inertia). Collective.
  int eigenvalues_below() const { return factor_.negative_pivots(); }
  /// Number of them below a value, by another factorisation. Collective.
  int eigenvalues_below(double value) const {
    return MumpsFactor(matrix_.get(), value).negative_pivots();
  }

 private:
  MatHandle matrix_;
  double shift_;
  MumpsFactor factor_;
};

/// Refuses matrices from files under which some motion has negative strain energy, or takes energy
/// out of its damping: M^-1 K and M^-1 D must have no eigenvalue below -1e-11 of the largest. That
/// is counted by a factorisation L D L^T (MUMPS) of either. Does nothing for structures of
/// elements. Throws UserError on every rank alike. Collective.
void require_passive_matrices(const Structure& structure, const LinearSystem& system);

/// Throws UserError (one line, on every rank alike) if the stiffness of a structure whose elements
/// have axial forces has a negative eigenvalue: it buckles. A factorisation counts those below
/// -1e-13 of K scaled to a unit diagonal. The group is that whose axial forces do most work in the
/// motion of the lowest one, which inverse iteration finds. Needs the matrix of the system.
/// Collective.
void require_no_buckling(const Structure& structure, const Mesh& mesh, const LinearSystem& system,
                         const LargestCompression& largest);

}  // namespace pounding
