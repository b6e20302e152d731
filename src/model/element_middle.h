#pragma once

#include <cstdint>
#include <string>

#include "mesh/mesh.h"

namespace pounding {

/// Middle of an element of a block [m], the mean of its nodes. Local.
Vector3 element_middle(const Mesh& mesh, const ElementBlock& block, std::size_t element);

/// Middle of the element of a group that has a number in the mesh file [m]; the origin where this
/// rank knows no such element. Local.
Vector3 element_middle(const Mesh& mesh, const std::string& group, std::int64_t number);

}  // namespace pounding
