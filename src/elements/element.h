#pragma once

#include <span>

#include "elements/element_traits.h"

/// Element matrices as the assembly asks for them: pure functions of coordinates and properties, no
/// MPI, no PETSc. Matrices are row-major in the element's own dofs, node by node: (ux, uy, uz) per
/// node, followed by (rx, ry, rz) where the element has rotations, all in global axes.
namespace pounding {

/// Number of the formulations: a change of the values of an element's stiffness or mass adds one,
/// so that no modal basis stored before is taken for a basis of today's matrices.
inline constexpr int element_formulations = 2;

ElementLayout element_layout(ElementType type);

/// Stiffness matrix, shape (size, size) [N/m, N, N m], and lumped mass, shape (size) [kg, kg m2],
/// of one element with node coordinates of shape (nodes, 3) [m]. Throws ElementError.
void element_matrices(ElementType type, std::span<const double> coordinates,
                      const ElementProperties& properties, std::span<double> stiffness,
                      std::span<double> lumped_mass);

/// Damping matrix of the dashpots in springs, shape (size, size) [N s/m, N m s]; all zero for every
/// other element.
void element_dashpots(ElementType type, const ElementProperties& properties,
                      std::span<double> damping);

/// Lumped mass alone, as `element_matrices` gives it. Throws ElementError.
void element_lumped_mass(ElementType type, std::span<const double> coordinates,
                         const ElementProperties& properties, std::span<double> lumped_mass);

}  // namespace pounding
