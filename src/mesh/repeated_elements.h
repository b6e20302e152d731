#pragma once

#include <string>

#include "mesh/global_mesh.h"

namespace pounding {

/// Throws UserError, naming both, where two elements lie on the same nodes: solids or shells of any
/// groups, lines and points of one group. Serial.
void check_repeated_elements(const std::string& structure, const GlobalMesh& mesh);

}  // namespace pounding
