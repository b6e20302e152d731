#include "interactions/pairing/pair_terms.h"

#include <cmath>

namespace pounding::interactions {
namespace {

/// A weight this close to 1 is the node itself; one this close to 0 is not there.
constexpr double negligible = 1e-6;

}  // namespace

std::array<double, 4> snapped(std::array<double, 4> weights) {
  for (double& weight : weights) {
    if (std::abs(weight) <= negligible) weight = 0;
  }
  for (std::size_t a = 0; a < weights.size(); ++a) {
    if (weights[a] <= 1 - negligible) continue;
    weights.fill(0);
    weights[a] = 1;
  }
  return weights;
}

void add_terms(int structure, GlobalIndex node, double weight, const Vector3& normal,
               Constraint& constraint) {
  for (int d = 0; d < 3; ++d) {
    const double coefficient = weight * normal[d];
    if (coefficient != 0) constraint.terms.push_back({structure, node, d, coefficient});
  }
}

}  // namespace pounding::interactions
