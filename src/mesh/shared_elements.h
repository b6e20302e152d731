#pragma once

#include "mesh/raw_mesh.h"

namespace pounding {

/// Makes one element of the copies that a file has of an element in several physical groups, one
/// per group, as format 2.2 of Gmsh writes it: on one entity, of one type, with the same nodes. The
/// first one stays. More copies than groups are left: they are another mistake.
/// Serial.
void merge_shared_elements(RawMesh& mesh);

}  // namespace pounding
