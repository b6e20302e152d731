#pragma once

#include <array>
#include <span>

#include "elements/element_properties.h"

/// Six-node wedge of isotropic linear elasticity, three displacements per node. Nodes in Gmsh's
/// order: bottom triangle 0-2 counter-clockwise seen from above, top 3-5. The displacement is
/// linear in the triangle times linear across it, without incompatible modes: stiffer in bending
/// than hex8, as hex8_full is.
namespace pounding {

inline constexpr std::array<ElementFace, 5> wedge6_faces{
    {{{0, 1, 2}, 3}, {{3, 4, 5}, 3}, {{0, 1, 4, 3}, 4}, {{1, 2, 5, 4}, 4}, {{2, 0, 3, 5}, 4}}};

/// Stiffness, shape (18, 18) [N/m], of a wedge with node coordinates of shape (6, 3) [m], by three
/// points in the triangle times two across it; uses young [Pa] and poisson. Symmetric to the bit.
/// Throws ElementError for a wedge that is flat or turned inside out at one of these points, naming
/// the Jacobian found.
void wedge6_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> stiffness);

/// Lumped mass, shape (18) [kg]: row sums of the consistent mass, the integral of density N_a, the
/// same in the three directions. Throws ElementError as the stiffness does.
void wedge6_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                        std::span<double> lumped_mass);

}  // namespace pounding
