#include "modal/shifted_solver.h"

#include "modal/factorisation.h"

namespace pounding {

ShiftedSolver::ShiftedSolver(const LinearSystem& system, Mat matrix, double shift)
    : system_(system) {
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

int ShiftedSolver::eigenvalues_below() const {
  PC factorisation = nullptr;
  Mat factor = nullptr;
  PetscInt negative = 0;
  POUNDING_PETSC(KSPGetPC(solver_.get(), &factorisation));
  POUNDING_PETSC(PCFactorGetMatrix(factorisation, &factor));
  POUNDING_PETSC(MatGetInertia(factor, &negative, nullptr, nullptr));
  return static_cast<int>(negative);
}

}  // namespace pounding
