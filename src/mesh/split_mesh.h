#pragma once

#include "mesh/raw_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Splits every line, triangle, quadrangle, tetrahedron, wedge and hexahedron of a mesh in the
/// middle of its edges into 2, 4 or 8 of the same kind and orientation. New nodes are in the middle
/// of edges, faces and cells: a curved surface keeps its flat facets. Lines of bars and springs of
/// the structure stay whole: in pieces they were another thing. A group of points gets the new
/// nodes between points of it, as supports along an edge need it, unless it is a region of the
/// structure. Numbers of nodes are kept. Serial.
void split_mesh(const Structure& structure, RawMesh& mesh);

}  // namespace pounding
