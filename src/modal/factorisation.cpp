#include "modal/factorisation.h"

#include <string>

namespace pounding {

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
    POUNDING_PETSC(
        PetscOptionsSetValue(nullptr, option.c_str(), std::to_string(factor_workspace).c_str()));
  }
}

}  // namespace pounding
