#include "modal/shifted_solver.h"

namespace pounding {
namespace {

/// Another owner of a matrix.
MatHandle reference_to(Mat matrix) {
  POUNDING_PETSC(PetscObjectReference(reinterpret_cast<PetscObject>(matrix)));
  MatHandle reference;
  *reference.out() = matrix;
  return reference;
}

}  // namespace

ShiftedSolver::ShiftedSolver(Mat matrix, double shift)
    : matrix_(reference_to(matrix)), shift_(shift), factor_(matrix, shift) {}

void ShiftedSolver::solve(std::vector<double>& x) const {
  factor_.solve(x.data(), 1);
}

void ShiftedSolver::solve(DenseMatrix& x) const {
  factor_.solve(x.values.data(), x.columns);
}

int ShiftedSolver::eigenvalues_below() const {
  return factor_.negative_pivots();
}

int ShiftedSolver::eigenvalues_below(double value) const {
  return MumpsFactor(matrix_.get(), value).negative_pivots();
}

}  // namespace pounding
