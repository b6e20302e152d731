#pragma once

#include "common/dense_matrix.h"
#include "common/petsc.h"
#include "system/linear_system.h"

namespace pounding {

/// Coordinates w of a structure with pools that have cells, in which M + S is the unit matrix:
/// y = F w, y = M^1/2 u, F of its AddedMass; those of the dofs that no water moves are y. Of a
/// structure without such pools w is y.
class WaterCoordinates {
 public:
  /// Collective, as all of it.
  explicit WaterCoordinates(const LinearSystem& system);

  /// F^T B F in place of B, if there is a matrix.
  void restrict_matrix(MatHandle& matrix) const;
  /// F w of columns over the owned dofs, and F^T of such forces on y.
  void to_scaled(DenseMatrix& w) const { multiply(w, MatMult); }
  void from_force(DenseMatrix& f) const { multiply(f, MatMultTranspose); }

 private:
  void multiply(DenseMatrix& x, PetscErrorCode (*product)(Mat, Vec, Vec)) const;

  const LinearSystem& system_;
  MatHandle half_;  ///< F; null without water
};

}  // namespace pounding
