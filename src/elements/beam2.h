#pragma once

#include <span>

#include "elements/element_properties.h"

/// Two-node Euler-Bernoulli beam in space, three displacements and three rotations per node. Local
/// x runs from node 1 to node 2; local z is `z_axis` made orthogonal to x; y = z cross x.
namespace pounding {

/// Stiffness in global axes, shape (12, 12) [N/m, N, N m], of a beam with node coordinates of shape
/// (2, 3) [m]: cubic bending in the local x-z plane (inertia_y) and in the x-y plane (inertia_z),
/// linear stretch (area) and twist (torsion), with G = E / (2 (1 + nu)). Exact for loads at nodes.
/// Symmetric to the bit. Throws ElementError for a zero length or a z_axis along the beam.
void beam2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                     std::span<double> stiffness);

/// Lumped mass in global axes, shape (12) [kg, kg m2]. At each node, m = rho A + added_mass:
/// translations m L / 2; rotation about local y (z) m L^3 / 24 + rho I_y (I_z) L / 2; about local x
/// rho (I_y + I_z) L / 2; the rotary part turned to global axes and its diagonal kept. Throws
/// ElementError as the stiffness does.
void beam2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                       std::span<double> lumped_mass);

}  // namespace pounding
