#include "stiffness/stiffness.h"

namespace pounding::stiffness {

AssembledStiffness::AssembledStiffness(MatHandle matrix) : matrix_(std::move(matrix)) {
  POUNDING_PETSC(MatCreateVecs(matrix_.get(), argument_.out(), force_.out()));
}

void AssembledStiffness::finish(const StiffnessArgument& w, ForceReceiver& receiver) const {
  PetscInt size = 0;
  POUNDING_PETSC(VecGetLocalSize(argument_.get(), &size));
  double* argument = nullptr;
  POUNDING_PETSC(VecGetArrayWrite(argument_.get(), &argument));
  for (PetscInt i = 0; i < size; ++i) argument[i] = w[i];
  POUNDING_PETSC(VecRestoreArrayWrite(argument_.get(), &argument));
  POUNDING_PETSC(MatMult(matrix_.get(), argument_.get(), force_.get()));
  const VecReader force(force_.get());
  receiver.receive(0, static_cast<LocalIndex>(size), force.data());
}

}  // namespace pounding::stiffness
