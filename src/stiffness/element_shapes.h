#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "stiffness/common_values.h"
#include "stiffness/element_frames.h"

namespace pounding::stiffness {

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
