#pragma once

#include <memory>
#include <vector>

#include "common/matrix3.h"
#include "elements/element_traits.h"
#include "stiffness/rows/element_rows.h"
#include "stiffness/rows/product.h"

namespace pounding::stiffness {

/// Common data of congruent bricks.
struct BrickShape {
  ElementType type = ElementType::hex8;
  ElementProperties properties;
  Vector3 lengths{};
};

/// Product of the bricks of one frame. `rows` of splittable bricks of `shapes`; `axes`: rows are
/// the axes of the frame.
std::unique_ptr<ElementLines> brick_lines(const DofSlots& slots, const Matrix3& axes,
                                          const std::vector<BrickShape>& shapes,
                                          const BrickRows& rows);

}  // namespace pounding::stiffness
