#pragma once

#include <string>
#include <vector>

#include "mesh/global_mesh.h"

namespace pounding {

/// Throws UserError, naming both, where two elements lie on the same nodes: solids or shells of any
/// groups, lines and points of one group. Serial.
void check_repeated_elements(const std::string& structure, const GlobalMesh& mesh);

/// Leaves the first facet of those on the same nodes, in their order. Serial.
void drop_repeated_facets(std::vector<Facet>& facets);

}  // namespace pounding
