#include "stiffness/shells/shell_class.h"

#include <cstddef>

#include "stiffness/rows/parity_split.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t corner_count = 4;
/// Corner bits of Gmsh's node order.
constexpr std::array<std::size_t, corner_count> gmsh_corner{0, 1, 3, 2};

/// Rows of H.
constexpr std::size_t sum = 0;
constexpr std::size_t along = 1;   // the run
constexpr std::size_t across = 2;  // it
constexpr std::size_t both = 3;

/// Place in B of component c, row s, both named by the run.
std::size_t place(std::size_t c, std::size_t s, int run_axis) {
  constexpr std::array<std::size_t, 6> other_component{1, 0, 2, 4, 3, 5};
  constexpr std::array<std::size_t, 4> other_row{sum, across, along, both};
  return run_axis == 0 ? s + corner_count * c : other_row[s] + corner_count * other_component[c];
}

}  // namespace

std::optional<ShellSplit> split_rectangle(const ElementProperties& properties,
                                          const std::array<double, 2>& lengths, int run_axis) {
  BlockPicker picker(stiffness_by_parity(ElementType::shell4, properties,
                                         {lengths[0], lengths[1], 0}, gmsh_corner));
  const auto value = [&](std::size_t c, std::size_t s) { return place(c, s, run_axis); };
  ShellSplit split;
  split.stretch = picker.take2(value(0, along), value(1, across));
  split.bending = {picker.take2(value(1, both), value(5, across)),
                   picker.take2(value(0, both), value(5, along))};
  split.shear = picker.take3(value(0, across), value(1, along), value(5, sum));
  split.drilling = picker.take1(value(5, both));
  split.curvature = picker.take2(value(3, across), value(4, along));
  split.slope = {picker.take2(value(2, along), value(4, sum)),
                 picker.take2(value(2, across), value(3, sum))};
  split.twist = picker.take3(value(2, both), value(3, along), value(4, across));
  split.hourglass = {picker.take1(value(3, both)), picker.take1(value(4, both))};
  return picker.took_all() ? std::optional(split) : std::nullopt;
}

}  // namespace pounding::stiffness
