#pragma once

/// Two-node beam in space, three displacements and three rotations per node, flexible in shear
/// where it has shear areas (Timoshenko), without them an Euler-Bernoulli beam. Local x runs from
/// node 1 to node 2; local z is `z_axis` made orthogonal to x; y = z cross x.

#include <span>

#include "elements/element_properties.h"

namespace pounding {

/// Flexibility in shear over that in bending of a beam of length L [-], 0 without a shear area:
/// Phi_y = 12 E I_z / (G A_y L^2) in the local x-y plane, Phi_z = 12 E I_y / (G A_z L^2) in x-z.
struct ShearFlexibility {
  double y = 0;
  double z = 0;
};
ShearFlexibility shear_flexibility(const ElementProperties& properties, double length);

/// Half of the shortest wave in which an endless beam bends at a circular frequency [m], in either
/// plane, by its continuous equation: with k = pi / half wave
///
///     E I k^4 - w^2 (rho I + m E I / (G A_s)) k^2 = w^2 m (1 - w^2 rho I / (G A_s))
double half_wave(const ElementProperties& properties, double frequency);

/// The lowest circular frequency at which half a wave of bending is so long [rad/s], in either
/// plane, by the same equation.
double wave_frequency(const ElementProperties& properties, double half_wave);

/// Stiffness in global axes, shape (12, 12) [N/m, N, N m], of a beam with node coordinates of shape
/// (2, 3) [m]: bending in the local x-z plane (inertia_y) and in the x-y plane (inertia_z),
/// linear stretch (area) and twist (torsion), with G = E / (2 (1 + nu)). In one plane
///
///     E I / (L^3 (1 + Phi)) [12  6L  -12  6L;  6L  (4 + Phi) L^2  -6L  (2 - Phi) L^2;  ...]
///
/// which is exact for loads at nodes. Symmetric to the bit. Throws ElementError for a zero length
/// or a z_axis along the beam.
void beam2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                     std::span<double> stiffness);

/// Lumped mass in global axes, shape (12) [kg, kg m2]. At each node, m = rho A + added_mass:
/// translations m L / 2; rotation about local y (z) J = rho I_y (I_z) L / 2; about local x
/// rho (I_y + I_z) L / 2; the rotary part turned to global axes and its diagonal kept.
///
/// A long slender beam is given rotary inertia D about y (z) beside J as far as its bending needs
/// it to allow the time step of its stretch, which is that of the largest frequency w_s = 2 / L
/// (E A / m)^1/2. D stays so small that no motion x of the beam has more than .1 % of it,
///
///     x^T D x <= .001 x^T (M + K / w^2) x,      w = resolved_frequency
///
/// from which follows, summed over elements, that no mode of a frequency up to w falls by more than
/// .1 %. With K_q = 12 E I / (L^3 (1 + Phi)), a = m L / 4, b = K_q / w^2, both in closed form:
///
///     D <= .001 (J + min(2 E I / (L w^2), L^2 / 2 a b / (a + b)))
///     J + D = L^2 / 2 / (w_s^2 / K_q - 1 / a)            the bending keeps up with the stretch
///
/// Throws ElementError as the stiffness does.
void beam2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                       std::span<double> lumped_mass);

/// Rotary inertia D that a beam has at a node beside its own, the larger of both planes, over its
/// own [-].
double added_rotary_part(const ElementProperties& properties, double length);

/// Lumped mass of beams without flexibility in shear: that above with m L^3 / 24 + rho I_y (I_z) L
/// / 2 about local y (z), as if the halves of the beam turned with its nodes.
void euler_beam_lumped_mass(std::span<const double> coordinates,
                            const ElementProperties& properties, std::span<double> lumped_mass);

// Two-node bar, pinned at both ends: three displacements per node, force along its axis only.

/// Matrix of a spring or dashpot `value` along the line of two nodes, shape (6, 6), symmetric to
/// the bit. Throws ElementError for a zero length.
void bar2_matrix(std::span<const double> coordinates, double value, std::span<double> matrix);

/// Stiffness E A / L along the axis, shape (6, 6) [N/m], of a bar with node coordinates of shape
/// (2, 3) [m]. Symmetric to the bit. Throws ElementError for a zero length.
void bar2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness);

/// Lumped mass, shape (6) [kg]: rho A L / 2 in the three directions of each node. Throws
/// ElementError as the stiffness does.
void bar2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass);

}  // namespace pounding
