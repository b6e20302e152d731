#include "stiffness/bricks/brick_class.h"

#include <cstddef>

#include "stiffness/rows/parity_split.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t corner_count = 8;
/// Corner bits of Gmsh's node order.
constexpr std::array<std::size_t, corner_count> gmsh_corner{0, 1, 3, 2, 4, 5, 7, 6};

constexpr std::size_t value(std::size_t component, std::size_t axes) {
  return axes + corner_count * component;
}

}  // namespace

std::optional<BrickSplit> split_brick(ElementType type, const ElementProperties& properties,
                                      const Vector3& lengths) {
  BlockPicker picker(stiffness_by_parity(type, properties, lengths, gmsh_corner));
  BrickSplit split;
  split.dilation = picker.take3(value(0, 1), value(1, 2), value(2, 4));
  split.twist = picker.take3(value(0, 6), value(1, 5), value(2, 3));
  split.bending = {picker.take2(value(1, 3), value(2, 5)), picker.take2(value(0, 3), value(2, 6)),
                   picker.take2(value(0, 5), value(1, 6))};
  split.shear = {picker.take2(value(0, 2), value(1, 1)), picker.take2(value(0, 4), value(2, 1)),
                 picker.take2(value(1, 4), value(2, 2))};
  split.hourglass = {picker.take1(value(0, 7)), picker.take1(value(1, 7)),
                     picker.take1(value(2, 7))};
  return picker.took_all() ? std::optional(split) : std::nullopt;
}

}  // namespace pounding::stiffness
