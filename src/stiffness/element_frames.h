#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "common/matrix3.h"

namespace pounding::stiffness {

/// An element whose nodes are the corners of a rectangular box, in the axes of frame number
/// `frame`; or those of a rectangle, a box that is flat along axis `normal`.
struct Box {
  int frame = -1;
  int normal = -1;    ///< of a rectangle
  Vector3 lengths{};  ///< edges along the axes of the frame [m]
  /// Place in the element's own node list of the corner on the far side of axis d where bit d is
  /// set; -1 for the far side of the normal.
  std::array<int, 8> corner{};
};

/// Orthonormal axes (rows) in which boxes of one structure lie. Frame 0: the global axes.
class ElementFrames {
 public:
  /// The box that eight nodes, the rectangle that four nodes in Gmsh's order, shape (nodes, 3) [m],
  /// form in one of the frames, to `tolerance` of its shortest edge. Nothing for other shapes.
  std::optional<Box> recognise(std::span<const double> coordinates, double tolerance) const;
  /// Axes along the edges of a box or rectangle; nothing for other shapes.
  static std::optional<Matrix3> axes_of_box(std::span<const double> coordinates, double tolerance);

  void add(const Matrix3& axes) { axes_.push_back(axes); }
  /// Each new shape is tried in all of them: there cannot be many.
  bool full() const { return axes_.size() >= 32; }
  const Matrix3& axes(int frame) const { return axes_[frame]; }

 private:
  std::vector<Matrix3> axes_{{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}};
};

}  // namespace pounding::stiffness
