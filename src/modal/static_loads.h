#pragma once

#include <vector>

#include "common/dense_matrix.h"
#include "mesh/mesh.h"
#include "modal/modal_request.h"
#include "system/linear_system.h"
#include "system/load_shapes.h"

namespace pounding {

/// Owned dof of a point, -1 if it is clamped, does not exist or is another rank's. Local.
LocalIndex owned_dof(const Mesh& mesh, const TracePoint& point);

/// Those of the points that are dofs, on whatever rank, in their order. Collective.
std::vector<TracePoint> free_points(MPI_Comm comm, const Mesh& mesh,
                                    const std::vector<TracePoint>& points);

/// M^-1/2 p of a load, by owned dof. Local.
std::vector<double> scaled_load(const LinearSystem& system, const LoadShape& shape);

/// M^-1/2 times the forces whose static responses a basis is to hold, shape (owned dofs, forces):
/// gravity, the system's loads, unit forces at contact points or equal ones on their patches, and
/// unit forces at sections that yield. Collective.
DenseMatrix static_loads(const LinearSystem& system, const Mesh& mesh, const ModalRequest& request);

}  // namespace pounding
