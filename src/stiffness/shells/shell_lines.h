#pragma once

#include <array>
#include <memory>
#include <vector>

#include "common/matrix3.h"
#include "elements/element_traits.h"
#include "stiffness/rows/element_rows.h"
#include "stiffness/rows/product.h"

namespace pounding::stiffness {

/// Common data of congruent rectangles.
struct RectangleShape {
  ElementProperties properties;
  /// Edges along the two axes that follow the normal in cyclic order [m].
  std::array<double, 2> lengths{};
};

/// Product of the rectangular shells that lie in the planes across one axis, `normal`, of a frame.
/// `rows` of splittable rectangles of `shapes`; `axes`: rows are the axes of the frame.
std::unique_ptr<ElementLines> shell_lines(const DofSlots& slots, const Matrix3& axes, int normal,
                                          const std::vector<RectangleShape>& shapes,
                                          const RectangleRows& rows);

}  // namespace pounding::stiffness
