#pragma once

/// Moves values between the dofs of nodes and the arrays that the bricks work on. Arrays are
/// written up to most_lanes - 1 values beyond their length.

#include <array>
#include <cstddef>

#include "common/matrix3.h"
#include "stiffness/rows/product.h"

namespace pounding::stiffness {

/// Three arrays, one per component.
struct ComponentArrays {
  double* x = nullptr;
  double* y = nullptr;
  double* z = nullptr;
};

/// w, less its origin, of `count` nodes with dofs x, y, z in a row from slots[p].
void load_nodes(const StiffnessArgument& w, const LocalIndex* slots, int count,
                const ComponentArrays& to);
/// Loads nodes whose dofs follow each other from `first`: a row.
void load_row(const StiffnessArgument& w, LocalIndex first, int count, const ComponentArrays& to);
/// Two such rows: their sum, and the second one minus the first.
void load_row_pair(const StiffnessArgument& w, std::array<LocalIndex, 2> first, int count,
                   const ComponentArrays& sum, const ComponentArrays& difference);

/// The way back: dof `first` stands at q[0].
void store_nodes(const ComponentArrays& from, const LocalIndex* slots, int count, LocalIndex first,
                 double* q);
void store_row(const ComponentArrays& from, int count, double* q);

/// Axes in which a line holds its vectors: those of a frame in some order, or the global ones.
struct LineAxes {
  LineAxes() = default;
  LineAxes(const Matrix3& frame, const std::array<int, 3>& order);
  /// Turns the vectors in three arrays from `line` on from global axes, or back.
  void turn(bool back, int count, std::ptrdiff_t stride, double* line) const;

  bool rotated = false;
  Matrix3 axes{};                  ///< of the frame, in that order
  std::array<int, 3> component{};  ///< where x, y, z stand in a line
};

// Moves values between the dofs of nodes that own six components in a row and the arrays that
// rectangles work on.

/// One array per component: x, y, z and the rotations about them.
using SixArrays = std::array<double*, 6>;

/// w of `count` nodes whose dofs start at slots[p].
void load_shell_nodes(const StiffnessArgument& w, const LocalIndex* slots, int count,
                      const SixArrays& to);

/// The way back: dof `first` stands at q[0].
void store_shell_nodes(const SixArrays& from, const LocalIndex* slots, int count, LocalIndex first,
                       double* q);

}  // namespace pounding::stiffness
