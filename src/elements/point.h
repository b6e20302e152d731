#pragma once

#include <array>
#include <span>

#include "elements/element_properties.h"

/// Elements without shape: masses on nodes, and springs or dashpots to the ground or between two
/// nodes, uncoupled along and about the global axes.
namespace pounding {

/// Mass [kg] on the displacements, as much of it as moves along each, and, if `lumped_mass` has six
/// entries, inertia [kg m2] on the rotations of a node.
void point_lumped_mass(const ElementProperties& properties, std::span<double> lumped_mass);

/// Matrix of six springs (or dashpots) `values` along and about x, y, z: diagonal for one node,
/// [k -k; -k k] for two. Shape (size, size) of the layout, row-major. The two nodes of a spring are
/// meant to coincide: a force across its length makes no moment.
void spring_matrix(const ElementLayout& layout, const std::array<double, 6>& values,
                   std::span<double> matrix);

/// Motion of a point that an arm [m] joins rigidly to a node, from that of the node: shape (6, 6),
/// u + theta x arm, and theta.
std::array<std::array<double, 6>, 6> motion_at(const Vector3& arm);

/// Matrix of springs to the ground, or of their dashpots, of the motion of the node: shape (6, 6),
/// row-major. `value`: &GroundSpring::stiffness or &GroundSpring::dashpot.
void ground_spring_matrix(std::span<const GroundSpring> springs, double GroundSpring::*value,
                          std::span<double> matrix);

}  // namespace pounding
