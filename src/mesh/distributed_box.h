#pragma once

#include <mpi.h>

#include "mesh/bounding_box.h"
#include "mesh/mesh.h"

namespace pounding {

/// Bounding box of every node of a distributed mesh, which has at least one. Collective.
BoundingBox bounding_box(MPI_Comm comm, const Mesh& mesh);

}  // namespace pounding
