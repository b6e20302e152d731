#pragma once

#include <array>
#include <vector>

#include "common/types.h"

namespace pounding {

/// Counts the independent rigid motions that some components of nodes see: how many of a piece's
/// motions its supports prevent.
class RigidRank {
 public:
  /// `origin` and `size` > 0 [m] of the piece make lengths and angles comparable.
  RigidRank(const Vector3& origin, double size) : origin_(origin), size_(size) {}

  /// Adds component 0-5 of a node (translations, rotations).
  void add(const Vector3& node, int component);
  int rank() const { return static_cast<int>(basis_.size()); }

 private:
  Vector3 origin_;
  double size_;
  std::vector<std::array<double, 6>> basis_;  ///< orthonormal
};

}  // namespace pounding
