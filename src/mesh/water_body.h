#pragma once

#include <span>
#include <vector>

#include "common/integer_sets.h"
#include "mesh/global_mesh.h"
#include "mesh/raw_mesh.h"

namespace pounding {

/// Coordinates of a set of nodes by the order of their tags, shape (count, 3) [m].
std::vector<double> coordinates_of(const RawMesh& raw, const NumberSet& nodes, std::size_t count);

/// Cells of the water of a pool as a mesh of its own, out of the parts of its group. Throws
/// UserError: none of dimension 3, or cells of another kind. Serial.
GlobalMesh water_cells(const Pool& pool, const std::vector<RawGroup>& parts, const RawMesh& raw);

/// Water of a pool out of its `cells`, sets of tet4, hex8_full and wedge6; `of_structure` is the
/// number of each of their nodes in the structure, -1 for one of the water alone. Level faces at
/// the highest nodes are the free surface, all others must have nodes of the structure.
/// Throws UserError: a face of neither kind, water without a free surface or a wetted node, nodes
/// of the structure inside it, cells that are flat or turned inside out. Serial.
WaterBody join_water(const Pool& pool, const GlobalMesh& cells,
                     std::span<const GlobalIndex> of_structure);

/// Refuses waters of a structure whose nodes follow a rigid group or a tie, or lie in two of them.
/// Throws UserError. Serial.
void check_wetted_nodes(const GlobalMesh& mesh);

}  // namespace pounding
