#pragma once

#include <functional>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "system/linear_system.h"

namespace pounding {

/// Factor L D L^T of a symmetric matrix by MUMPS, its rows ordered, none of its numbers computed.
struct FactorPlan {
  MatHandle factor;
  double memory = 0;  ///< that it will take on all ranks together, as MUMPS expects [B]
};

/// Orders the rows; `workspace` [per cent]: beyond MUMPS's own estimate. Collective over the
/// matrix.
FactorPlan plan_factor(Mat matrix, int workspace);

/// Memory that a factor may take [B]: 0.8 of the memory that the system could still give, since its
/// size is an estimate. Local.
double memory_for_factor();

/// Displacement of the owned dofs in a rigid motion, along (0-2) or about (3-5) an axis through a
/// point. Local.
std::vector<double> rigid_motion(const Mesh& mesh, int motion, const Vector3& point);

/// Rigid motions of a structure as the near null space of a matrix of its owned dofs, from which
/// algebraic multigrid makes its coarse grids; `to_coordinates` takes a field of displacements to
/// the coordinates of the matrix. Motions that a row of nodes does not have are left out.
/// Collective.
void set_near_null_space(const LinearSystem& system, const Mesh& mesh, Mat matrix,
                         const std::function<void(std::vector<double>&)>& to_coordinates);

}  // namespace pounding
