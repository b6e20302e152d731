#include "system/factor_plan.h"

#include <array>

#include "common/matrix3.h"
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

std::vector<double> rigid_motion(const Mesh& mesh, int motion, const Vector3& point) {
  std::vector<double> field(mesh.owned_dofs, 0.0);
  for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex node, int c) {
    const Vector3 arm = minus(mesh.position(node), point);
    field[dof] = rigid_motion_row(static_cast<std::size_t>(c), arm)[motion];
  });
  return field;
}

void set_near_null_space(const LinearSystem& system, const Mesh& mesh, Mat matrix,
                         const std::function<void(std::vector<double>&)>& to_coordinates) {
  std::array<VecHandle, 6> motions;
  std::vector<Vec> kept;
  for (int m = 0; m < 6; ++m) {
    std::vector<double> field = rigid_motion(mesh, m, {0, 0, 0});
    to_coordinates(field);
    const VecHandle wrapped = wrap_vector(system, field);
    POUNDING_PETSC(VecDuplicate(wrapped.get(), motions[m].out()));
    POUNDING_PETSC(VecCopy(wrapped.get(), motions[m].get()));
    // Orthonormal, as PETSc wants them.
    for (int repeat = 0; repeat < 2; ++repeat) {
      for (Vec other : kept) {
        PetscScalar product = 0;
        POUNDING_PETSC(VecDot(motions[m].get(), other, &product));
        POUNDING_PETSC(VecAXPY(motions[m].get(), -product, other));
      }
    }
    PetscReal length = 0;
    PetscReal before = 0;
    POUNDING_PETSC(VecNorm(wrapped.get(), NORM_2, &before));
    POUNDING_PETSC(VecNorm(motions[m].get(), NORM_2, &length));
    if (!(length > 1e-8 * before)) continue;  // a straight row of nodes: no motion of its own
    POUNDING_PETSC(VecScale(motions[m].get(), 1 / length));
    kept.push_back(motions[m].get());
  }
  PetscHandle<MatNullSpace, MatNullSpaceDestroy> rigid;
  POUNDING_PETSC(MatNullSpaceCreate(system.comm, PETSC_FALSE, static_cast<PetscInt>(kept.size()),
                                    kept.data(), rigid.out()));
  POUNDING_PETSC(MatSetNearNullSpace(matrix, rigid.get()));
}

}  // namespace pounding
