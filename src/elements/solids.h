#pragma once

#include <array>
#include <span>

#include "elements/element_properties.h"

/// Solids of isotropic linear elasticity, three displacements per node, nodes in Gmsh's order. All
/// of a kind throw ElementError for an element that is flat or turned inside out at a point of
/// their rule, naming the Jacobian found; stiffnesses use young [Pa] and poisson and are symmetric
/// to the bit. Lumped masses [kg] are row sums of the consistent mass, the integral of density N_a,
/// the same in the three directions.
namespace pounding {

/// Eight-node brick: bottom 0-3 counter-clockwise seen from above, top 4-7.
inline constexpr std::array<ElementFace, 6> hex8_faces{{{{0, 1, 2, 3}, 4},
                                                        {{4, 5, 6, 7}, 4},
                                                        {{0, 1, 5, 4}, 4},
                                                        {{1, 2, 6, 5}, 4},
                                                        {{2, 3, 7, 6}, 4},
                                                        {{3, 0, 4, 7}, 4}}};

/// `full`: trilinear displacement alone, which locks in bending. `incompatible`: with the quadratic
/// modes 1 - xi^2, 1 - eta^2, 1 - zeta^2 added to each displacement component and condensed, in the
/// constant-Jacobian form that passes the patch test on any mesh (Taylor, Beresford and Wilson,
/// Int. J. Num. Meth. Eng. 10, 1976).
enum class Hex8Formulation { full, incompatible };

/// Stiffness, shape (24, 24) [N/m], of a brick with node coordinates of shape (8, 3) [m], by the
/// 2 x 2 x 2 Gauss rule.
void hex8_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    Hex8Formulation formulation, std::span<double> stiffness);

/// Lumped mass of a brick, shape (24).
void hex8_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass);

/// Six-node wedge: bottom triangle 0-2 counter-clockwise seen from above, top 3-5. The displacement
/// is linear in the triangle times linear across it, without incompatible modes: stiffer in bending
/// than hex8, as hex8_full is.
inline constexpr std::array<ElementFace, 5> wedge6_faces{
    {{{0, 1, 2}, 3}, {{3, 4, 5}, 3}, {{0, 1, 4, 3}, 4}, {{1, 2, 5, 4}, 4}, {{2, 0, 3, 5}, 4}}};

/// Stiffness, shape (18, 18) [N/m], of a wedge with node coordinates of shape (6, 3) [m], by three
/// points in the triangle times two across it.
void wedge6_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> stiffness);

/// Lumped mass of a wedge, shape (18).
void wedge6_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                        std::span<double> lumped_mass);

/// Four-node tetrahedron of constant strain: 0-2 counter-clockwise seen from 3. Far too stiff in
/// bending, and locking towards a Poisson's ratio of 0.5: hex8 and wedge6 need fewer nodes for the
/// same answer.
inline constexpr std::array<ElementFace, 4> tet4_faces{
    {{{0, 1, 2}, 3}, {{0, 1, 3}, 3}, {{1, 2, 3}, 3}, {{2, 0, 3}, 3}}};

/// Stiffness, shape (12, 12) [N/m], of a tetrahedron with node coordinates of shape (4, 3) [m].
void tet4_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness);

/// Lumped mass of a tetrahedron, shape (12): a quarter at each node.
void tet4_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass);

}  // namespace pounding
