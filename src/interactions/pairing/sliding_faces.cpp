#include "interactions/pairing/sliding_faces.h"

#include "common/parallel.h"

namespace pounding::interactions {

void broadcast_sliding_faces(MPI_Comm comm, SlidingFaces& faces) {
  broadcast_array(comm, faces.nodes);
  broadcast_array(comm, faces.facets);
  broadcast_array(comm, faces.rows);
  broadcast_array(comm, faces.candidates);
}

}  // namespace pounding::interactions
