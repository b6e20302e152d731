#pragma once

#include <string>
#include <vector>

#include "io/hdf5_file.h"
#include "mesh/mesh.h"
#include "mesh/node_table.h"
#include "output/xdmf.h"

namespace pounding {

/// How groups and contacts are marked in pictures of a scene. The same on every rank.
struct MeshLabels {
  std::vector<std::string> groups;  ///< of all structures, "left:slab"; their numbers from 1
  std::vector<std::size_t> first;   ///< per structure, of its regions among these
  std::vector<std::string> contacts;
  /// Per structure and contact, the nodes that are in a pair of it, in file order.
  std::vector<std::vector<std::vector<GlobalIndex>>> contact_nodes;
};

/// Adds a structure's mesh to a file, in a group of its name:
///
///     coordinates            (nodes, 3) [m], nodes in file order
///     topology               cells as in CellTable
///     group, element, rank   (cells) number in `groups`, number in the mesh file, owner
///     clamped                (nodes) 1 for x, 2 for y, 4 for z: the sum of held components
///     contact_NAME           (nodes) 1 in a pair of the contact, for each that the structure has
///
/// and returns the grid that shows it. `file` is read on rank 0, where `cells` are. Throws
/// UserError on every rank alike (no space). Collective.
XdmfGrid write_mesh(Hdf5File* file, const Mesh& mesh, const CellTable& cells, std::size_t structure,
                    const MeshLabels& labels);

/// Writes whole numbers per node or cell to a folder of a file, and adds them to those of a grid.
/// Rank 0.
void add_numbers(Hdf5File& file, const std::string& folder, const std::string& name,
                 const std::vector<std::int32_t>& values, std::vector<XdmfArray>& arrays);

/// Names behind their numbers from 1, "1 left:slab, 2 left:wall", as a note of a grid has them.
std::string numbered(const std::vector<std::string>& names);

/// Adds the names of the groups to a file as `groups`. Rank 0.
void write_group_names(Hdf5File& file, const MeshLabels& labels);

}  // namespace pounding
