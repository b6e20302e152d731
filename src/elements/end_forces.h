#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "elements/element_traits.h"

/// Forces in elements of two nodes and in grounded springs, as linear forms of their dofs.
namespace pounding {

/// Names of the forces of an element, in their order. Of a beam N (tension above 0), Vy, Vz, T and
/// the bending moments at its two ends, My1, Mz1, My2, Mz2: they act on a section whose normal is
/// the local x, in the local axes of beam2.h, and N, Vy, Vz and T are the same all along, since
/// loads act at nodes. Of a bar N. Of springs the forces and moments along the global axes that
/// pull node 2 back to node 1, or a node back to the ground. Empty for every other element.
std::span<const std::string_view> end_force_names(ElementType type);

/// Coefficients of these forces, shape (forces, dofs of the element) [N/m, N, N m], from the
/// stiffness matrix in global axes, shape (dofs, dofs). Throws ElementError as the stiffness does.
std::vector<double> end_force_rows(ElementType type, std::span<const double> coordinates,
                                   const ElementProperties& properties,
                                   std::span<const double> stiffness);

}  // namespace pounding
