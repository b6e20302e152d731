#pragma once

#include <array>
#include <span>
#include <vector>

#include "interactions/pairing/interface.h"

namespace pounding::interactions {

/// The outward normal of the secondary side of a constraint, whose terms are the last ones: a unit
/// vector.
Vector3 normal_of(const Constraint& constraint);

/// Two unit vectors across a unit vector and each other; axes for an axis.
std::array<Vector3, 2> tangents_of(const Vector3& normal);

/// Two rows per constraint: what L is for gap rates, for the displacements along two tangents, in
/// the order of the constraints, with the same weights.
std::vector<Constraint> tangential_rows(std::span<const Constraint> constraints);

}  // namespace pounding::interactions
