#include "mesh/rigid_rank.h"

#include <cmath>
#include <numeric>

#include "common/rigid_motion.h"

namespace pounding {

void RigidRank::add(const Vector3& node, int component) {
  constexpr double independent = 1e-6;  // of a row of about unit length
  if (basis_.size() == 6) return;
  Vector3 arm = node;
  for (std::size_t d = 0; d < 3; ++d) arm[d] = (arm[d] - origin_[d]) / size_;
  std::array<double, 6> row = rigid_motion_row(static_cast<std::size_t>(component), arm);
  for (int turn = 0; turn < 2; ++turn) {
    for (const std::array<double, 6>& known : basis_) {
      const double share = std::inner_product(row.begin(), row.end(), known.begin(), 0.0);
      for (std::size_t i = 0; i < 6; ++i) row[i] -= share * known[i];
    }
  }
  const double length = std::sqrt(std::inner_product(row.begin(), row.end(), row.begin(), 0.0));
  if (length > independent) {
    for (double& value : row) value /= length;
    basis_.push_back(row);
  }
}

}  // namespace pounding
