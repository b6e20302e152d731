#pragma once

#include <array>
#include <span>

#include "elements/element_properties.h"

/// Eight-node brick of isotropic linear elasticity, three displacements per node. Nodes in Gmsh's
/// order: bottom 0-3 counter-clockwise seen from above, top 4-7.
namespace pounding {

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
/// 2 x 2 x 2 Gauss rule; uses young [Pa] and poisson. Symmetric to the bit. Throws ElementError for
/// a brick that is flat or turned inside out at a Gauss point, naming the Jacobian found.
void hex8_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    Hex8Formulation formulation, std::span<double> stiffness);

/// Lumped mass, shape (24) [kg]: row sums of the consistent mass, the integral of density N_a, the
/// same in the three directions. Throws ElementError as the stiffness does.
void hex8_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass);

}  // namespace pounding
