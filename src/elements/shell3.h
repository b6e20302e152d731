#pragma once

#include <span>

#include "elements/flat_shell.h"

/// Three-node flat shell, three displacements and three rotations per node, to fill the gaps of
/// quadrangle meshes. Its fields on an edge are those of shell4, so patch tests pass on mixed
/// meshes. Membrane: constant strain, hence stiff in in-plane bending. Plate: linear with
/// transverse shear tied along the edges, MITC3 (Lee and Bathe, Comput. Struct. 82, 2004), its
/// shear energy multiplied by t^2 / (t^2 + h^2 / 10), h the longest edge, which removes the locking
/// of thin plates and converges with the mesh (Lyly, Stenberg and Vihinen, Comput. Methods Appl.
/// Mech. Eng. 110, 1993). Drilling: see flat_shell.h.
namespace pounding {

/// Stiffness in global axes, shape (18, 18) [N/m, N, N m], of a shell with node coordinates of
/// shape (3, 3) [m]; uses young [Pa], poisson and thickness [m]. Symmetric to the bit. Throws
/// ElementError for a thickness or an area that is not positive.
void shell3_stiffness(std::span<const double> coordinates, const ShellProperties& properties,
                      std::span<double> stiffness);

/// Strains at the centre: those of membrane and bending are the same everywhere in it. Throws
/// ElementError as the stiffness does.
CentreStrains shell3_centre_strains(std::span<const double> coordinates,
                                    const ShellProperties& properties);

/// Lumped mass in global axes, shape (18) [kg, kg m2]: a third of the area at each node. Throws
/// ElementError as the stiffness does.
void shell3_lumped_mass(std::span<const double> coordinates, const ShellProperties& properties,
                        std::span<double> lumped_mass);

}  // namespace pounding
