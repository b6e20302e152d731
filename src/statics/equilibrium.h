#pragma once

#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "interactions/pairing/interface.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
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

/// The scene at rest under its gravity.
struct Equilibrium {
  std::vector<std::vector<double>> displacement;  ///< u_0 per structure, owned dofs [m, rad]
  /// Forces of element laws beside K u_0 likewise [N, N m]; empty where none is beyond its first
  /// corner.
  std::vector<std::vector<double>> law_force;
  std::vector<StructureRest> structures;
  std::vector<double> contact_force;  ///< p_0 per row of the interface, the same on all ranks [N]
  std::vector<double> opening;        ///< L u_0 likewise: by how much it is wider than unloaded [m]
  int acting_links = 0;               ///< tension-only bars and compression-only springs that carry
  int idle_links = 0;
  double gravity_potential = 0;  ///< -(f_g + f_l)^T u_0, of weight and loads [J]
  int iterations = 0;
  int rows_tried = 0;  ///< contact points and links that a solution was made for
  /// Root of the energy r^T (K + sigma M)^-1 r of the force r that the start leaves, over that of
  /// the weight [-].
  double residual = 0;
};

/// Static equilibrium of all structures with their contacts, tension-only bars and
/// compression-only springs (see UnilateralRows):
///
///     K u_0 + g(u_0) = M g + p + R^T f,      0 <= f _|_ w0 + R u_0 + c f >= 0
///
/// g(u_0) the forces beside K u_0 of elements and links that yield, whose history goes from nothing
/// to u_0 at once: weight and loads come together, in proportion. By the proximal point method
/// (Rockafellar, SIAM J. Control Optim. 14 (1976), 877), which needs no stiffness that holds by
/// itself, so that blocks which only rest on each other pass:
///
///     (K + sigma M) d = M g + p + R^T f - K u - g(u),       u <- u + d,
///     with f such that the rows are fulfilled by u + d
///
/// with p the loads as they are before the run (LoadShapes).
/// sigma = 1 / s2 shrinks the error by 1 / (1 + omega^2 / sigma) at a held frequency omega, and
/// refines the solution like any correction by its residual. Slopes of laws lie between 0 and those
/// of K, with which it converges as well, sped up by the last steps together. Forces are measured
/// by their energy f^T (K + sigma M)^-1 f, in which a moment on the small rotary inertia of a thin
/// shell counts by the bending that it causes. Rows that no iterate violates are never solved for.
/// A structure that nothing holds against its weight falls on for ever: UserError naming it.
/// Systems need their matrix. `open_rows`: per row of the interface, whether the contact is open
/// whatever its gap is, which is given for the rest. Collective.
Equilibrium find_equilibrium(MPI_Comm comm, std::span<const LinearSystem> systems,
                             std::span<const Mesh> meshes, const interactions::Interface& interface,
                             std::span<const char> open_rows, SolverChoice solver);

}  // namespace pounding
