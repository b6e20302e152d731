#pragma once

#include <array>
#include <span>

#include "elements/element_properties.h"

/// Four-node tetrahedron of isotropic linear elasticity, three displacements per node, constant
/// strain. Nodes in Gmsh's order: 0-2 counter-clockwise seen from 3. Far too stiff in bending, and
/// locking towards a Poisson's ratio of 0.5: hex8 and wedge6 need fewer nodes for the same answer.
namespace pounding {

inline constexpr std::array<ElementFace, 4> tet4_faces{
    {{{0, 1, 2}, 3}, {{0, 1, 3}, 3}, {{1, 2, 3}, 3}, {{2, 0, 3}, 3}}};

/// Stiffness, shape (12, 12) [N/m], of a tetrahedron with node coordinates of shape (4, 3) [m];
/// uses young [Pa] and poisson. Symmetric to the bit. Throws ElementError for a tetrahedron that is
/// flat or turned inside out, naming the Jacobian found.
void tet4_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness);

/// Lumped mass, shape (12) [kg]: a quarter of the mass at each node, the same in the three
/// directions. Throws ElementError as the stiffness does.
void tet4_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass);

}  // namespace pounding
