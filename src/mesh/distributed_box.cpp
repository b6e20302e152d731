#include "mesh/distributed_box.h"

namespace pounding {

BoundingBox bounding_box(MPI_Comm comm, const Mesh& mesh) {
  BoundingBox box;
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) box.include(mesh.position(node));
  MPI_Allreduce(MPI_IN_PLACE, box.low.data(), 3, MPI_DOUBLE, MPI_MIN, comm);
  MPI_Allreduce(MPI_IN_PLACE, box.high.data(), 3, MPI_DOUBLE, MPI_MAX, comm);
  return box;
}

}  // namespace pounding
