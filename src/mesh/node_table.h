#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

/// Values of a structure as a table that does not depend on the partition: shape (global_nodes,
/// columns) on rank 0, nodes in file order, the components x, y, z, then the rotations about them.
namespace pounding {

/// Components that a table of this structure needs: 6 if any node rotates, else 3. Collective.
std::size_t component_columns(const Mesh& mesh);

/// The table of values over owned dofs, 0 where there is no free dof; empty on the other ranks.
/// Collective.
std::vector<double> gather_by_node(const Mesh& mesh, std::span<const double> values,
                                   std::size_t columns);

/// Values over owned dofs as rows per owned node, shape (owned_nodes, columns), 0 where there is no
/// free dof. Local.
std::vector<double> node_rows(const Mesh& mesh, std::span<const double> values,
                              std::size_t columns);

/// Values over owned dofs out of such rows. Local.
std::vector<double> dof_values(const Mesh& mesh, std::span<const double> rows, std::size_t columns);

/// The table of rows per owned node, shape (owned_nodes, columns); empty on the other ranks.
/// Collective.
std::vector<double> gather_node_rows(const Mesh& mesh, std::vector<double> rows,
                                     std::size_t columns);

/// Positions of all nodes [m], shape (global_nodes, 3); empty on the other ranks. Collective.
std::vector<double> gather_coordinates(const Mesh& mesh);

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
