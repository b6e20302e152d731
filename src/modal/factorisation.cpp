#include "modal/factorisation.h"

#include <cstdlib>
#include <string>

namespace pounding {
namespace {

/// Beyond what MUMPS expects [per cent].
constexpr const char* workspace = "100";

}  // namespace

void factorise_with_mumps(PC factorisation) {
  POUNDING_PETSC(PCSetType(factorisation, PCCHOLESKY));
  POUNDING_PETSC(PCFactorSetMatSolverType(factorisation, MATSOLVERMUMPS));
  const char* prefix = nullptr;
  POUNDING_PETSC(PCGetOptionsPrefix(factorisation, &prefix));
  const std::string option =
      std::string("-") + (prefix == nullptr ? "" : prefix) + "mat_mumps_icntl_14";
  PetscBool given = PETSC_FALSE;
  POUNDING_PETSC(PetscOptionsHasName(nullptr, nullptr, option.c_str(), &given));
  if (given == PETSC_FALSE) {
    POUNDING_PETSC(PetscOptionsSetValue(nullptr, option.c_str(), workspace));
  }
}

double factor_memory(Mat matrix) {
  MatHandle factor;
  MatFactorInfo info;
  POUNDING_PETSC(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.out()));
  constexpr PetscInt more_workspace = 14;
  constexpr PetscInt megabytes_of_all = 17;
  POUNDING_PETSC(MatMumpsSetIcntl(factor.get(), more_workspace, std::atoi(workspace)));
  POUNDING_PETSC(MatFactorInfoInitialize(&info));
  POUNDING_PETSC(MatCholeskyFactorSymbolic(factor.get(), matrix, nullptr, &info));
  PetscInt megabytes = 0;
  POUNDING_PETSC(MatMumpsGetInfog(factor.get(), megabytes_of_all, &megabytes));
  return 1e6 * static_cast<double>(megabytes);
}

}  // namespace pounding
