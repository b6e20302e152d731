#pragma once

#include <string>

#include "mesh/global_mesh.h"

namespace pounding {

/// The largest distance between two nodes of an element that holds the node [m]; 0 where none has
/// an extent. Serial.
double element_size_at(const GlobalMesh& mesh, GlobalIndex node);

/// Throws UserError, naming the element, where two nodes of an element that has length, area or
/// volume lie at one place: closer than 1e-12 of the diagonal of the mesh. Serial.
void check_element_sizes(const std::string& structure, const GlobalMesh& mesh);

}  // namespace pounding
