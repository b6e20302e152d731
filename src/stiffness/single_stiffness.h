#pragma once

#include <span>

#include "elements/element_traits.h"

namespace pounding::stiffness {

/// Whether an element is a hexahedron of general shape, whose numbers may have 32 bits: boxes share
/// theirs, extruded ones have few. Node coordinates of shape (nodes, 3) [m].
bool may_round(ElementType type, std::span<const double> coordinates);

/// Makes the stiffness of an element, shape (size, size), that of its numbers in 32 bits, symmetric
/// to the bit, if it is kept in such (SingleHexahedron): the K of a structure with `numbers`
/// single, where it is not applied by strains.
void round_to_single(ElementType type, std::span<const double> coordinates,
                     std::span<double> stiffness);

}  // namespace pounding::stiffness
