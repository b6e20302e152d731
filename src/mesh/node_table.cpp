#include "mesh/node_table.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

#include "common/parallel.h"

namespace pounding {
namespace {

/// Calls `function(owned dof, place in the rows)` for every owned dof.
template <typename Function>
void for_each_owned_dof(const Mesh& mesh, std::size_t columns, Function&& function) {
  pounding::for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex node, int c) {
    const auto component = static_cast<std::size_t>(c);
    if (component >= columns) return;
    function(static_cast<std::size_t>(dof), static_cast<std::size_t>(node) * columns + component);
  });
}

/// Cells of some ranks, one after the other: set, number and number of nodes of each, and its
/// nodes.
struct CellList {
  std::vector<std::int64_t> heads;  ///< shape (cells, 3)
  std::vector<GlobalIndex> nodes;

  static void members(auto& self, auto& stream) { stream(self.heads, self.nodes); }
};

CellList own_cells(const Mesh& mesh) {
  CellList list;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const int width = traits_of(block.type).layout.nodes;
    for (std::size_t e = 0; e < block.count(); ++e) {
      if (block.counted[e] == 0) continue;
      list.heads.insert(list.heads.end(), {static_cast<std::int64_t>(b), block.tags[e], width});
      for (int a = 0; a < width; ++a) {
        const std::size_t place = e * static_cast<std::size_t>(width) + static_cast<std::size_t>(a);
        list.nodes.push_back(mesh.file_node[block.connectivity[place]]);
      }
    }
  }
  return list;
}

/// A cell on rank 0 while all are sorted.
struct TaggedCell {
  std::int64_t set;
  std::int64_t tag;
  std::size_t first;  ///< node
  std::size_t width;
  int rank;
};

}  // namespace

std::vector<double> gather_node_rows(const Mesh& mesh, std::vector<double> rows,
                                     std::size_t columns) {
  const bool root = rank_of(mesh.comm) == 0;
  std::vector<double> table(root ? static_cast<std::size_t>(mesh.global_nodes) * columns : 0);
  std::vector<GlobalIndex> owned(mesh.file_node.begin(), mesh.file_node.begin() + mesh.owned_nodes);
  for_each_rank(mesh.comm, std::pair(std::move(owned), std::move(rows)),
                [&](int /*rank*/, const auto& own) {
                  const auto& [nodes, values] = own;
                  for (std::size_t i = 0; i < nodes.size(); ++i) {
                    std::copy_n(&values[i * columns], columns,
                                &table[static_cast<std::size_t>(nodes[i]) * columns]);
                  }
                });
  return table;
}

std::size_t component_columns(const Mesh& mesh) {
  const bool rotates =
      std::ranges::any_of(mesh.free_components, [](std::uint8_t mask) { return mask > 0x07; });
  return on_any_rank(mesh.comm, rotates) ? 6 : 3;
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

void add_cell(std::span<const GlobalIndex> nodes, bool solid, std::vector<std::int32_t>& topology) {
  const auto count = static_cast<std::int32_t>(nodes.size());
  switch (count) {
    case 1:  // polyvertex and polyline say how many nodes they have
    case 2:
      topology.insert(topology.end(), {count, count});
      break;
    case 3:
      topology.push_back(4);
      break;
    case 4:
      topology.push_back(solid ? 6 : 5);
      break;
    case 6:
      topology.push_back(8);
      break;
    case 8:
      topology.push_back(9);
      break;
    default:
      throw std::logic_error("no cell has " + std::to_string(count) + " nodes");
  }
  for (const GlobalIndex node : nodes) topology.push_back(static_cast<std::int32_t>(node));
}

CellTable gather_cells(const Mesh& mesh) {
  std::vector<GlobalIndex> nodes;
  std::vector<TaggedCell> places;
  for_each_rank(mesh.comm, own_cells(mesh), [&](int rank, const CellList& list) {
    std::size_t first = nodes.size();
    for (std::size_t i = 0; i < list.heads.size(); i += 3) {
      const auto width = static_cast<std::size_t>(list.heads[i + 2]);
      places.push_back({list.heads[i], list.heads[i + 1], first, width, rank});
      first += width;
    }
    nodes.insert(nodes.end(), list.nodes.begin(), list.nodes.end());
  });
  std::ranges::stable_sort(
      places, {}, [](const TaggedCell& place) { return std::tuple(place.set, place.tag); });
  CellTable table;
  for (const TaggedCell& place : places) {
    const ElementBlock& block = mesh.blocks[static_cast<std::size_t>(place.set)];
    add_cell({&nodes[place.first], place.width}, is_solid(block.type), table.topology);
    table.region.push_back(block.region);
    table.element.push_back(static_cast<std::int32_t>(place.tag));
    table.rank.push_back(place.rank);
  }
  return table;
}

}  // namespace pounding
