#pragma once

#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/pairing/interface.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "statics/structure_rest.h"
#include "system/linear_system.h"

namespace pounding {

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
/// g(u_0) the forces beside K u_0 of elements that yield, whose history goes from nothing
/// to u_0 at once: weight and loads come together, in proportion. By the proximal point method
/// (Rockafellar, SIAM J. Control Optim. 14 (1976), 877), which needs no stiffness that holds by
/// itself, so that blocks which only rest on each other pass:
///
///     (K + sigma M) d = M g + p + R^T f - K u - g(u),       u <- u + d,
///     with f such that the rows are fulfilled by u + d
///
/// with p the loads as they are before the run (LoadShapes). Springs between mats on one soil are
/// in g(u) as well.
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
