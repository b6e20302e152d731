#pragma once

#include <span>

#include "elements/element_traits.h"
#include "scene/structure.h"

namespace pounding::stiffness {

/// Whether an element is a hexahedron of general shape, whose numbers may have 32 bits: boxes share
/// theirs, extruded ones have few. Node coordinates of shape (nodes, 3) [m].
bool may_round(ElementType type, std::span<const double> coordinates);

/// Matrices of an element as a structure with these `numbers` has them, where they are not applied
/// by strains: those of `element_matrices`, the stiffness being that of its numbers in 32 bits,
/// symmetric to the bit, if it is kept in such (SingleHexahedron). Throws ElementError.
void element_matrices_in(Numbers numbers, ElementType type, std::span<const double> coordinates,
                         const ElementProperties& properties, std::span<double> stiffness,
                         std::span<double> lumped_mass);

}  // namespace pounding::stiffness
