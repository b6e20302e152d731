#include "system/near_null_space.h"

#include <array>

#include "common/rigid_motion.h"

namespace pounding {
namespace {

/// Displacement of the free dofs in a rigid motion, along (0-2) or about (3-5) an axis through the
/// origin.
std::vector<double> rigid_motion(const Mesh& mesh, int motion) {
  std::vector<double> field(mesh.owned_dofs, 0.0);
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof < 0) continue;
      field[dof] = rigid_motion_row(static_cast<std::size_t>(c), mesh.position(node))[motion];
    }
  }
  return field;
}

}  // namespace

void set_near_null_space(const LinearSystem& system, const Mesh& mesh, Mat matrix,
                         const std::function<void(std::vector<double>&)>& to_coordinates) {
  std::array<VecHandle, 6> motions;
  std::vector<Vec> kept;
  for (int m = 0; m < 6; ++m) {
    std::vector<double> field = rigid_motion(mesh, m);
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
