#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "mesh/mesh.h"
#include "statics/assembled_statics.h"
#include "system/linear_system.h"

namespace pounding {

/// Forces that hold one structure at rest, and how far it settles.
struct StructureRest {
  Vector3 weight{0, 0, 0};      ///< total mass x its gravity [N]
  Vector3 load{0, 0, 0};        ///< of its loads before the run [N]
  Vector3 contact{0, 0, 0};     ///< of contact points on it [N]
  Vector3 support{0, 0, 0};     ///< of clamps, grounded springs and bars to the ground on it [N]
  Vector3 settlement{0, 0, 0};  ///< mean displacement over its mass, clamped nodes included [m]
  double largest_displacement = 0;  ///< of a component; 0 of a reduced structure [m]
  std::string place;                ///< where that is; empty of a reduced structure
  double forces = 0;  ///< sum of |f_i| over the dofs, of weight and loads: pairs of loads count
  /// |weight + load + contact + support| over the largest of them and `forces`, the support summed
  /// up from K u; 0 of a reduced structure, whose support follows from the others [-].
  double imbalance = 0;
  std::string method;  ///< how its stiffness was solved
};

/// Displacements and forces of a structure at rest, over the owned dofs.
struct RestFields {
  const std::vector<double>& displacement;
  const std::vector<double>& weight;     ///< and loads as they are at rest
  const std::vector<double>& law_force;  ///< of elements that yield, beside K u
  const std::vector<double>& contact;
  const std::vector<double>& links;  ///< one-way ones
  Vector3 pushed;                    ///< by all contacts, held nodes included [N]
};

/// The balance of a structure at rest. Collective.
StructureRest describe_rest(MPI_Comm comm, const LinearSystem& system, const Mesh& mesh,
                            const StaticStiffness& stiffness, const RestFields& at);

}  // namespace pounding
