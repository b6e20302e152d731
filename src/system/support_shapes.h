#pragma once

#include <map>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// How a structure follows supports that move on their own. With r_c(t) the components of their
/// motions relative to the scene's ground (columns c), the displacement relative to that ground is
///
///     u_total = u + sum_c iota_c r_c,      K iota_c + K_s w_c = 0 at free dofs
///
/// with w_c the rigid motion of the clamped nodes of a support, K_s the stiffness between free and
/// clamped dofs, and u the unknown of the LinearSystem's equations: loads -M iota_c r_c'' come to
/// them, and no other, since K gives no force on iota_c.
struct SupportShapes {
  std::vector<SupportColumn> columns;  ///< of all supports of the scene
  /// iota_c of each column over the owned dofs [-, m, 1/m]; in generalised coordinates M_q^-1 Phi^T
  /// M iota_c. Empty for columns of supports under which the structure has no node.
  std::vector<std::vector<double>> shape;
  /// Shapes at the places whose displacement is known, per column; in generalised coordinates only.
  std::map<TracePoint, std::vector<double>> at_points;
};

/// Displacement or rotation of a component of a clamped node under a unit of a column: 0 where the
/// node is not on that support, or is free in the component.
double support_displacement(const SupportColumn& column, const Mesh& mesh, LocalIndex node,
                            int component);

/// Displacement or rotation of the ground under a grounded spring, dashpot or soil at a node, under
/// a unit of a column: that of the node itself where all the ground moves with the support, else 0.
double ground_displacement(const SupportColumn& column, const Mesh& mesh, LocalIndex node,
                           int component);

/// K_s w of a column over the owned dofs [N, N m]: forces that the free nodes' neighbours on the
/// support, and its ground under springs, put on them, of linear elements only. Sums run over the
/// elements in file order. Throws UserError naming an element that is impossible. Local.
std::vector<double> support_force(const Structure& structure, const Mesh& mesh,
                                  const SupportColumn& column);

/// out[stride * k] = the sum over columns of values[k][c] x motion[c], added to the old values.
void add_columns(std::span<const double> values, std::span<const double> motion, double* out,
                 std::size_t stride);

}  // namespace pounding
