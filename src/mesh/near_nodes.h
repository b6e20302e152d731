#pragma once

#include <utility>
#include <vector>

#include "mesh/global_mesh.h"

namespace pounding {

/// Pairs of nodes (the lower number first, in increasing order) at most `near` > 0 [m] apart,
/// found in cells of a grid. Serial.
std::vector<std::pair<GlobalIndex, GlobalIndex>> near_nodes(const GlobalMesh& mesh, double near);

}  // namespace pounding
