#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <mpi.h>

#include "common/matrix3.h"
#include "mesh/mesh.h"
#include "stiffness/element_loop.h"

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

/// Part of its shortest edge to which elements have one shape.
inline constexpr double congruence = 1e-10;

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

/// Values that differ by round-off become one, the same on every rank and for any number of ranks.
class CommonValues {
 public:
  /// Values no farther than `tolerance` > 0 from another one belong together.
  explicit CommonValues(double tolerance) : tolerance_(tolerance) {}

  void add(double value);
  /// Puts the values of all ranks together. Collective.
  void agree(MPI_Comm comm);
  /// Value that one that was added stands for after `agree`: the middle of those that belong
  /// together. Where there are too many different ones to compare, a multiple of the tolerance.
  double operator()(double value) const;

 private:
  void add_range(double low, double high);

  double tolerance_;
  std::map<double, double> ranges_;  ///< from the lowest to the highest value that belong together
  bool too_many_ = false;
};

/// Shapes of the hexahedra and quadrangles of a mesh, to 1e-10 of the shortest edge: elements that
/// differ by less get one shape, the same on every rank and for any number of ranks, so that the
/// ranks that share an element have the same stiffness for it.
class ElementShapes {
 public:
  /// Collective.
  explicit ElementShapes(const Mesh& mesh);

  /// The box, or the rectangle, that an element is, or null.
  const Box* box(std::size_t block, std::size_t element) const;
  const Matrix3& axes(int frame) const { return frames_.axes(frame); }
  /// Node coordinates of the shape, shape (nodes, 3) [m], the first node at the origin.
  std::vector<double> coordinates(std::size_t block, std::size_t element) const;
  /// Those, or of an element that has no shape its own, into `work`.
  void find_coordinates(std::size_t block, std::size_t element, ElementWork& work) const;

 private:
  void find_frames();
  void find_boxes(std::size_t block);
  void find_common_values(std::size_t block, double tolerance);
  std::vector<double> own_coordinates(std::size_t block, std::size_t element) const;

  const Mesh& mesh_;
  ElementFrames frames_;
  std::vector<std::vector<Box>> boxes_;  ///< per block and element; frame -1: no box
  /// Per block: lengths of boxes, and what the coordinates of other elements are from their first
  /// node on.
  std::vector<CommonValues> lengths_;
  std::vector<CommonValues> distances_;
};

}  // namespace pounding::stiffness
