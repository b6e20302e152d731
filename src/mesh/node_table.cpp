#include "mesh/node_table.h"

#include <algorithm>

#include "common/parallel.h"

namespace pounding {
namespace {

std::vector<GlobalIndex> owned_file_nodes(const Mesh& mesh) {
  return {mesh.file_node.begin(), mesh.file_node.begin() + mesh.owned_nodes};
}

/// Calls `function(owned dof, place in the rows)` for every owned dof.
template <typename Function>
void for_each_owned_dof(const Mesh& mesh, std::size_t columns, Function&& function) {
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (std::size_t component = 0; component < columns; ++component) {
      const LocalIndex dof = mesh.dof(node, static_cast<int>(component));
      if (dof >= 0) {
        function(static_cast<std::size_t>(dof),
                 static_cast<std::size_t>(node) * columns + component);
      }
    }
  }
}

}  // namespace

std::vector<double> gather_node_rows(const Mesh& mesh, std::vector<double> rows,
                                     std::size_t columns) {
  std::vector<GlobalIndex> nodes = owned_file_nodes(mesh);
  if (rank_of(mesh.comm) != 0) {
    send_array(mesh.comm, 0, nodes);
    send_array(mesh.comm, 0, rows);
    return {};
  }
  std::vector<double> table(static_cast<std::size_t>(mesh.global_nodes) * columns, 0.0);
  for (int rank = 0; rank < size_of(mesh.comm); ++rank) {
    if (rank > 0) {
      receive_array(mesh.comm, rank, nodes);
      receive_array(mesh.comm, rank, rows);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      std::copy_n(&rows[i * columns], columns,
                  &table[static_cast<std::size_t>(nodes[i]) * columns]);
    }
  }
  return table;
}

std::size_t component_columns(const Mesh& mesh) {
  int rotates = std::any_of(mesh.free_components.begin(), mesh.free_components.end(),
                            [](std::uint8_t mask) { return mask > 0x07; });
  MPI_Allreduce(MPI_IN_PLACE, &rotates, 1, MPI_INT, MPI_MAX, mesh.comm);
  return rotates != 0 ? 6 : 3;
}

std::vector<double> node_rows(const Mesh& mesh, std::span<const double> values,
                              std::size_t columns) {
  std::vector<double> rows(static_cast<std::size_t>(mesh.owned_nodes) * columns, 0.0);
  for_each_owned_dof(mesh, columns,
                     [&](std::size_t dof, std::size_t place) { rows[place] = values[dof]; });
  return rows;
}

std::vector<double> dof_values(const Mesh& mesh, std::span<const double> rows,
                               std::size_t columns) {
  std::vector<double> values(mesh.owned_dofs);
  for_each_owned_dof(mesh, columns,
                     [&](std::size_t dof, std::size_t place) { values[dof] = rows[place]; });
  return values;
}

std::vector<double> gather_by_node(const Mesh& mesh, std::span<const double> values,
                                   std::size_t columns) {
  return gather_node_rows(mesh, node_rows(mesh, values, columns), columns);
}

std::vector<double> gather_coordinates(const Mesh& mesh) {
  std::vector<double> rows(mesh.coordinates.begin(),
                           mesh.coordinates.begin() + 3 * mesh.owned_nodes);
  return gather_node_rows(mesh, std::move(rows), 3);
}

}  // namespace pounding
