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

}  // namespace pounding
