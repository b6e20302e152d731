#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"
#include "system/brick_class.h"
#include "system/common_values.h"

namespace pounding {

/// Shapes of the hexahedra of a mesh, to 1e-10 of the shortest edge: elements that differ by less
/// get one shape, the same on every rank and for any number of ranks, so that the ranks that share
/// an element have the same stiffness for it.
class ElementShapes {
 public:
  /// Collective.
  explicit ElementShapes(const Mesh& mesh);

  /// The box that an element of a block of hexahedra is, or null.
  const Brick* brick(std::size_t block, std::size_t element) const;
  const Matrix3& axes(int frame) const { return frames_.axes(frame); }
  /// Node coordinates of the shape, shape (8, 3) [m], the first node at the origin.
  std::array<double, 24> coordinates(std::size_t block, std::size_t element) const;

 private:
  void find_frames();
  void find_bricks(std::size_t block);
  void find_common_values(std::size_t block, double tolerance);
  std::array<double, 24> own_coordinates(std::size_t block, std::size_t element) const;

  const Mesh& mesh_;
  BrickFrames frames_;
  std::vector<std::vector<Brick>> bricks_;  ///< per block and element; frame -1: no box
  /// Per block: lengths of boxes, and what the coordinates of other elements are from their first
  /// node on.
  std::vector<CommonValues> lengths_;
  std::vector<CommonValues> distances_;
};

}  // namespace pounding
