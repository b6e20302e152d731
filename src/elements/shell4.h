#pragma once

#include <span>

#include "elements/flat_shell.h"

/// Four-node flat shell, three displacements and three rotations per node. Nodes follow each other
/// around the element. Membrane: bilinear with the quadratic modes 1 - xi^2, 1 - eta^2 condensed,
/// in the form that passes the patch test (Taylor, Beresford and Wilson, Int. J. Num. Meth. Eng.
/// 10, 1976). Plate: bilinear with transverse shear tied at the middle of the edges, MITC4 (Bathe
/// and Dvorkin, Int. J. Num. Meth. Eng. 21, 1985). Drilling: see flat_shell.h. All by the 2 x 2
/// Gauss rule. A warped element is projected on the plane that halves the distance between its
/// diagonals; rigid links carry the nodes.
namespace pounding {

/// Largest distance of a node from the mean plane, over the square root of the area.
inline constexpr double largest_warp = 0.1;

/// Stiffness in global axes, shape (24, 24) [N/m, N, N m], of a shell with node coordinates of
/// shape (4, 3) [m]; uses young [Pa], poisson and thickness [m]. Symmetric to the bit. Throws
/// ElementError for a thickness or an area that is not positive, a corner that is re-entrant or
/// flat (nodes not in order around the element), warp above `largest_warp`.
void shell4_stiffness(std::span<const double> coordinates, const ShellProperties& properties,
                      std::span<double> stiffness);

/// Strains at the centre: the membrane and bending strains there are their means over the element,
/// whatever its shape, since the gradients of the modes vanish there. Throws ElementError as the
/// stiffness does.
CentreStrains shell4_centre_strains(std::span<const double> coordinates,
                                    const ShellProperties& properties);

/// Lumped mass in global axes, shape (24) [kg, kg m2]: the nodal area is the integral of N_a (a
/// quarter of the area of a parallelogram). Throws ElementError as the stiffness does.
void shell4_lumped_mass(std::span<const double> coordinates, const ShellProperties& properties,
                        std::span<double> lumped_mass);

}  // namespace pounding
