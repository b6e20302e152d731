#include "modal/shifted_solver.h"

#include <algorithm>

#include "modal/factorisation.h"

namespace pounding {

ShiftedSolver::ShiftedSolver(const LinearSystem& system, Mat matrix, double shift)
    : system_(system), shift_(shift) {
  POUNDING_PETSC(MatDuplicate(matrix, MAT_COPY_VALUES, shifted_.out()));
  POUNDING_PETSC(MatShift(shifted_.get(), -shift));
  POUNDING_PETSC(MatSetOption(shifted_.get(), MAT_SYMMETRIC, PETSC_TRUE));
  POUNDING_PETSC(KSPCreate(system.comm, solver_.out()));
  POUNDING_PETSC(KSPSetOptionsPrefix(solver_.get(), "lowest_st_"));
  POUNDING_PETSC(KSPSetType(solver_.get(), KSPPREONLY));
  PC factorisation = nullptr;
  POUNDING_PETSC(KSPGetPC(solver_.get(), &factorisation));
  factorise_with_mumps(factorisation);
  POUNDING_PETSC(KSPSetOperators(solver_.get(), shifted_.get(), shifted_.get()));
  POUNDING_PETSC(KSPSetFromOptions(solver_.get()));
  // MUMPS counts pivots on several ranks only if it factorises the last block on one of them.
  int ranks = 1;
  MPI_Comm_size(system.comm, &ranks);
  if (ranks > 1) {
    constexpr PetscInt root_on_one_rank = 13;
    Mat factor = nullptr;
    POUNDING_PETSC(PCFactorSetUpMatSolverType(factorisation));
    POUNDING_PETSC(PCFactorGetMatrix(factorisation, &factor));
    POUNDING_PETSC(MatMumpsSetIcntl(factor, root_on_one_rank, 1));
  }
  POUNDING_PETSC(KSPSetUp(solver_.get()));
}

void ShiftedSolver::solve(std::vector<double>& x) const {
  const VecHandle vector = wrap_vector(system_, x);
  POUNDING_PETSC(KSPSolve(solver_.get(), vector.get(), vector.get()));
}

void ShiftedSolver::solve(DenseMatrix& x) const {
  constexpr std::size_t portion = 32;  // columns for which the factor is read once
  PC factorisation = nullptr;
  Mat factor = nullptr;
  POUNDING_PETSC(KSPGetPC(solver_.get(), &factorisation));
  POUNDING_PETSC(PCFactorGetMatrix(factorisation, &factor));
  const auto rows = static_cast<PetscInt>(x.rows);
  for (std::size_t first = 0; first < x.columns; first += portion) {
    const auto count = static_cast<PetscInt>(std::min(portion, x.columns - first));
    MatHandle given;
    MatHandle solution;
    POUNDING_PETSC(MatCreateDense(system_.comm, rows, PETSC_DECIDE, PETSC_DETERMINE, count,
                                  x.column(first), given.out()));
    POUNDING_PETSC(MatDuplicate(given.get(), MAT_DO_NOT_COPY_VALUES, solution.out()));
    POUNDING_PETSC(MatMatSolve(factor, given.get(), solution.get()));
    const PetscScalar* values = nullptr;
    PetscInt stride = 0;
    POUNDING_PETSC(MatDenseGetLDA(solution.get(), &stride));
    POUNDING_PETSC(MatDenseGetArrayRead(solution.get(), &values));
    for (PetscInt j = 0; j < count; ++j) {
      std::copy_n(values + j * stride, x.rows, x.column(first + static_cast<std::size_t>(j)));
    }
    POUNDING_PETSC(MatDenseRestoreArrayRead(solution.get(), &values));
  }
}

int ShiftedSolver::eigenvalues_below() const {
  PC factorisation = nullptr;
  Mat factor = nullptr;
  PetscInt negative = 0;
  POUNDING_PETSC(KSPGetPC(solver_.get(), &factorisation));
  POUNDING_PETSC(PCFactorGetMatrix(factorisation, &factor));
  POUNDING_PETSC(MatGetInertia(factor, &negative, nullptr, nullptr));
  return static_cast<int>(negative);
}

int ShiftedSolver::eigenvalues_below(double value) const {
  return ShiftedSolver(system_, shifted_.get(), value - shift_).eigenvalues_below();
}

}  // namespace pounding
