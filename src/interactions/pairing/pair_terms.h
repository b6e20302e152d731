#pragma once

#include <array>

#include "common/matrix3.h"
#include "interactions/pairing/interface.h"

namespace pounding::interactions {

/// How far outside a facet, or deeper than its elements are, relative to its size, a node may lie
/// and still face it: shells in one plane lie as deep as they are thick.
constexpr double facet_tolerance = 1e-6;

/// Weights of a facet's nodes where those within 1e-6 of 0 are 0, and one within 1e-6 of 1 is the
/// node itself.
std::array<double, 4> snapped(std::array<double, 4> weights);

/// Adds a node to a constraint, with a weight along a normal.
void add_terms(int structure, GlobalIndex node, double weight, const Vector3& normal,
               Constraint& constraint);

}  // namespace pounding::interactions
