#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace pounding {

/// The elements of a structure as cells of a picture, in an order that does not depend on the
/// partition: region after region, then by number in the mesh file. On rank 0.
struct CellTable {
  /// Cell after cell as in XDMF's mixed topology: a code, for points and lines the number of nodes,
  /// then the nodes in file order.
  std::vector<std::int32_t> topology;
  std::vector<std::int32_t> region;   ///< per cell, index into the structure's regions
  std::vector<std::int32_t> element;  ///< per cell, its number in the mesh file
  std::vector<std::int32_t> rank;     ///< per cell, the one that counts it
  std::size_t count() const { return region.size(); }
};

/// Adds a cell of `nodes` nodes to a mixed topology; `solid` distinguishes a tetrahedron from a
/// quadrangle.
void add_cell(std::span<const GlobalIndex> nodes, bool solid, std::vector<std::int32_t>& topology);

/// The cells of all ranks; empty but on rank 0. Collective.
CellTable gather_cells(const Mesh& mesh);

}  // namespace pounding
