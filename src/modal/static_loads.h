#pragma once

#include <limits>
#include <span>
#include <vector>

#include "common/dense_matrix.h"
#include "common/types.h"
#include "mesh/mesh.h"
#include "mesh/nodal_load.h"
#include "system/linear_system.h"

namespace pounding {

/// Request for a basis: its content.
struct ModalRequest {
  int modes = 0;       ///< number of modes; 0: all below the cut-off
  int candidates = 0;  ///< number of lowest modes to choose them from; 0: no others
  double cutoff = 0;   ///< [Hz]
  int most_modes = std::numeric_limits<int>::max();  ///< of those below it
  bool attachment = true;                            ///< a vector per contact point as well
  bool residual = false;                             ///< and one per motion of the ground
  int patches = 0;           ///< or per patch of them, so many in all; 0: per point
  Vector3 gravity{0, 0, 0};  ///< that the structure is to rest under [m/s2]; 0: no vector for it
  std::vector<TracePoint> contact_points;
  std::vector<TracePoint> yielding_points;  ///< of sections that yield, never in patches
  std::vector<TracePoint> other_points;     ///< where the motion is wanted as well
  std::vector<TracePoint> shown_points;     ///< and for pictures and forces, which choose no modes
  std::vector<NodalLoad> loads;             ///< on the structure
  std::vector<double> loads_at_rest;        ///< f of each before the run
  NodalStart start;                         ///< of nodes that start differently
  std::vector<SupportColumn> supports;      ///< columns of the supports' motion
  Vector3 start_displacement{0, 0, 0};      ///< of the others [m]
  Vector3 start_velocity{0, 0, 0};          ///< of the others [m/s]
  double switched_part = 0;                 ///< of a structure that is switched [-]; 0: it is not
  /// The structure with (1 + d) / 2 of each element's stiffness, d the factor on its damping; null:
  /// all are 1.
  const LinearSystem* damping = nullptr;
};

/// Points that are dofs, on whatever rank, in their order. Collective.
std::vector<TracePoint> free_points(MPI_Comm comm, const Mesh& mesh,
                                    const std::vector<TracePoint>& points);

/// M^-1/2 p of the loads of a system, shape (owned dofs, loads). Local.
DenseMatrix scaled_loads(const LinearSystem& system);

/// M^1/2 u_0 and M^1/2 v_0 of the start of a system, shape (owned dofs, 2). Local.
DenseMatrix scaled_start(const LinearSystem& system);

/// M^-1/2 times the forces whose static responses a basis is to hold, shape (owned dofs, forces):
/// gravity, the system's loads, unit forces at contact points or equal ones on their patches, and
/// unit forces at sections that yield. Collective.
DenseMatrix static_loads(const LinearSystem& system, const Mesh& mesh, const ModalRequest& request);

/// Patches of contact points, as numbers of points: together `count` of them, or one more for each
/// axis along which points move, shared out by the number of points of each axis. Their middles are
/// points as far from each other as can be found one after the other (Gonzalez, Theor. Comput. Sci.
/// 38 (1985) 293); a point belongs to the nearest one. `positions`: of each point [m]. Serial; the
/// same for the same points.
std::vector<std::vector<std::size_t>> contact_patches(std::span<const TracePoint> points,
                                                      std::span<const Vector3> positions,
                                                      std::size_t count);

/// M^1/2 iota of the motions of the ground, shape (owned dofs, motions): x, y, z as one, and the
/// columns of its supports. Local.
DenseMatrix ground_loads(const LinearSystem& system);

/// M^1/2 iota of the columns of a system's supports, shape (owned dofs, columns); 0 where a support
/// has no node of the structure. Local.
DenseMatrix support_loads(const LinearSystem& system);

}  // namespace pounding
