#include "system/factor_plan.h"

#include "common/memory.h"

namespace pounding {

FactorPlan plan_factor(Mat matrix, int workspace) {
  FactorPlan plan;
  constexpr PetscInt more_workspace = 14;
  constexpr PetscInt megabytes_of_all = 17;
  POUNDING_PETSC(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, plan.factor.out()));
  POUNDING_PETSC(MatMumpsSetIcntl(plan.factor.get(), more_workspace, workspace));
  MatFactorInfo info;
  POUNDING_PETSC(MatFactorInfoInitialize(&info));
  POUNDING_PETSC(MatCholeskyFactorSymbolic(plan.factor.get(), matrix, nullptr, &info));
  PetscInt megabytes = 0;
  POUNDING_PETSC(MatMumpsGetInfog(plan.factor.get(), megabytes_of_all, &megabytes));
  plan.memory = 1e6 * static_cast<double>(megabytes);
  return plan;
}

double memory_for_factor() {
  constexpr double usable_share = 0.8;
  return usable_share * available_memory();
}

}  // namespace pounding
