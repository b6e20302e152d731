#pragma once

#include <array>

#include "stiffness/rows/product.h"

/// Moves values between the dofs of nodes that own six components in a row and the arrays that
/// rectangles work on.
namespace pounding::stiffness {

/// One array per component: x, y, z and the rotations about them.
using SixArrays = std::array<double*, 6>;

/// w of `count` nodes whose dofs start at places[p].
void load_shell_nodes(const StiffnessArgument& w, const LocalIndex* places, int count,
                      const SixArrays& to);

/// The way back: dof `first` stands at q[0].
void store_shell_nodes(const SixArrays& from, const LocalIndex* places, int count, LocalIndex first,
                       double* q);

}  // namespace pounding::stiffness
