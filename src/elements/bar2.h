#pragma once

#include <span>

#include "elements/element_properties.h"

/// Two-node bar, pinned at both ends: three displacements per node, force along its axis only.
namespace pounding {

/// Stiffness E A / L along the axis, shape (6, 6) [N/m], of a bar with node coordinates of shape
/// (2, 3) [m]. Symmetric to the bit. Throws ElementError for a zero length.
void bar2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness);

/// Lumped mass, shape (6) [kg]: rho A L / 2 in the three directions of each node. Throws
/// ElementError as the stiffness does.
void bar2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass);

}  // namespace pounding
