#include "stiffness/diagonal_stiffness.h"

namespace pounding::stiffness {

DiagonalStiffness::DiagonalStiffness(MPI_Comm comm, std::vector<double> diagonal)
    : diagonal_(std::move(diagonal)), force_(diagonal_.size(), 0.0) {
  const auto size = static_cast<PetscInt>(diagonal_.size());
  POUNDING_PETSC(MatCreateAIJ(comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE, 1, nullptr, 0,
                              nullptr, matrix_.out()));
  PetscInt first = 0;
  POUNDING_PETSC(MatGetOwnershipRange(matrix_.get(), &first, nullptr));
  for (PetscInt i = 0; i < size; ++i) {
    POUNDING_PETSC(MatSetValue(matrix_.get(), first + i, first + i, diagonal_[i], INSERT_VALUES));
  }
  POUNDING_PETSC(MatAssemblyBegin(matrix_.get(), MAT_FINAL_ASSEMBLY));
  POUNDING_PETSC(MatAssemblyEnd(matrix_.get(), MAT_FINAL_ASSEMBLY));
}

void DiagonalStiffness::finish(const StiffnessArgument& w, ForceReceiver& receiver) const {
  for (std::size_t i = 0; i < force_.size(); ++i) {
    force_[i] = diagonal_[i] * w[i];
  }
  receiver.receive(0, static_cast<LocalIndex>(force_.size()), force_.data());
}

void DiagonalStiffness::apply(Vec w, Vec q) const {
  const VecReader argument(w);
  double* force = nullptr;
  POUNDING_PETSC(VecGetArrayWrite(q, &force));
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    force[i] = diagonal_[i] * argument[static_cast<int>(i)];
  }
  POUNDING_PETSC(VecRestoreArrayWrite(q, &force));
}

}  // namespace pounding::stiffness
