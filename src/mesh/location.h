#pragma once

#include <span>
#include <string>

#include "mesh/mesh.h"

/// Names of places in a mesh, for messages.
namespace pounding {

/// "element 17 of group 'slab' at (x, y, z)", with its number in the mesh file and its centre.
/// Local.
std::string describe_element(const Mesh& mesh, const ElementBlock& block, std::size_t element);

/// Node and component of the largest |value| over the owned dofs of all ranks (a value that is not
/// a number counts as largest), and an element that holds the node. The same on all ranks.
/// Collective.
std::string locate_largest(const Mesh& mesh, std::span<const double> values);

/// Part of a field in the nodes of a region.
struct RegionShare {
  int region = -1;   ///< index into the structure's regions; -1: none
  double share = 0;  ///< of the sum of the squared values over all nodes
};

/// The region whose nodes have the largest part of a field over the owned dofs, by the squares of
/// its values; a node belongs to every region with an element there, and of equal parts the first
/// region has it. The same on all ranks. Collective.
RegionShare busiest_region(const Mesh& mesh, std::span<const double> values);

}  // namespace pounding
