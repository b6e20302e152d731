#include "mesh/rigid_rank.h"

#include <cmath>
#include <numeric>

namespace pounding {

void RigidRank::add(const Vector3& node, int component) {
  constexpr double independent = 1e-6;  // of a row of about unit length
  if (basis_.size() == 6) return;
  // The component's motion under unit translations and rotations: u = t + theta x r.
  std::array<double, 6> row{};
  row[component] = 1;
  if (component < 3) {
    const std::size_t c = component;
    const std::size_t next = (c + 1) % 3;
    const std::size_t last = (c + 2) % 3;
    row[3 + next] = (node[last] - origin_[last]) / size_;
    row[3 + last] = -(node[next] - origin_[next]) / size_;
  }
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
