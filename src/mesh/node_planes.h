#pragma once

#include <array>
#include <cstdint>

#include "mesh/global_mesh.h"

namespace pounding {

/// Order in which the nodes of a structure follow each other on a rank: in layers across the
/// longest extent, and in each layer in rows along the second longest. Neighbours in space are
/// neighbours in memory, rows of elements have their nodes side by side, and few rows are cut where
/// a long structure is. Serial.
class NodePlanes {
 public:
  explicit NodePlanes(const GlobalMesh& mesh);

  /// Place of a point: its layer, its row in the layer, its place in the row, as numbers of planes
  /// that are so close together that nodes of one plane have one number in spite of round-off.
  std::array<std::int64_t, 3> place(const Vector3& x) const;

 private:
  std::array<std::size_t, 3> axes_{0, 1, 2};
  Vector3 low_{};
  double spacing_ = 0;  ///< [m]
};

}  // namespace pounding
