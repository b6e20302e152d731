#pragma once

#include <array>
#include <optional>

#include "elements/element_traits.h"

namespace pounding::stiffness {

// Rectangular flat shells. A rectangle is unchanged by reflection in its two mid-lines, and its
// membrane knows nothing of its plate: its element matrix splits into blocks of at most 3 x 3.

/// A rectangle's stiffness split by parity. Axis 0 is the one along which rectangles follow each
/// other in a run, 1 the other one in the plane. Components 0, 1, 2 are displacements along axis 0,
/// axis 1 and the normal, 3, 4, 5 rotations about them. H is the 4-point Walsh-Hadamard transform;
/// value "c|s" stands for component c in row s of H, "c|-" for the sum over the nodes. With
/// B = H K H' / 16, K = H' B H and B holds only
///
///     membrane  stretch   2 x 2  0|0  1|1          plate  curvature  2 x 2  3|1  4|0
///               bending   2 x 2  1|01 5|1                 slope      2 x 2  2|0  4|-
///                                0|01 5|0                                   2|1  3|-
///               shear     3 x 3  0|1  1|0 5|-             twist      3 x 3  2|01 3|0 4|1
///               drilling  1      5|01                     hourglass  1      3|01
///                                                                           4|01
///
/// The translations 0|-, 1|- and 2|- drop out.
struct ShellSplit {
  std::array<double, 3> stretch{};                 ///< 00 01 11
  std::array<std::array<double, 3>, 2> bending{};  ///< the same
  std::array<double, 6> shear{};                   ///< 00 01 02 11 12 22
  double drilling = 0;
  std::array<double, 3> curvature{};
  std::array<std::array<double, 3>, 2> slope{};
  std::array<double, 6> twist{};
  std::array<double, 2> hourglass{};
};

/// Splits the stiffness of a shell4 rectangle with edges `lengths` [m] along two axes that form a
/// right-handed frame with the normal; axis `run_axis` (0 or 1) takes the place of axis 0. Nothing
/// when entries outside the pattern exceed 1e-13 of the largest.
std::optional<ShellSplit> split_rectangle(const ElementProperties& properties,
                                          const std::array<double, 2>& lengths, int run_axis);

/// A line of nodes: displacements and forces, component by component, those of the split's axes 0,
/// 1 and the normal first, then the rotations about them; array c starts c * line_stride further.
struct ShellLine {
  const double* displacement = nullptr;
  double* force = nullptr;
};

/// Adds the forces of `count` congruent rectangles in a row: rectangle i lies between the nodes i
/// and i + 1 of two lines of six components, line 0 on the near side of axis 1. Up to lane_count
/// values beyond node `count` are read, and zero is added to as many forces there. The order of the
/// sums does not depend on lane_count.
void add_shell_run(const ShellSplit& split, const std::array<ShellLine, 2>& lines, int line_stride,
                   int count);

}  // namespace pounding::stiffness
