#include "interactions/laws/damper_law.h"

#include <algorithm>
#include <cmath>

namespace pounding::interactions {
namespace {

constexpr int most_iterations = 200;

/// Root y of strength y^power + slope y = right with power >= 1, all others positive.
double root_of(double strength, double power, double slope, double right) {
  double y = std::min(right / slope, std::pow(right / strength, 1 / power));
  for (int i = 0; i < most_iterations; ++i) {
    const double raised = strength * std::pow(y, power);
    const double excess = raised + slope * y - right;
    const double next = y - excess / (power * raised / y + slope);
    if (!(next < y) || next <= 0) break;
    y = next;
  }
  return y;
}

}  // namespace

DamperLaw::DamperLaw(double strength, double exponent, double time_step)
    : exponent_(exponent), strength_(strength / std::pow(2 * time_step, exponent)) {}

double DamperLaw::force(double before, double /*now*/, double after,
                        std::span<const double>) const {
  const double change = after - before;
  return std::copysign(strength_ * std::pow(std::abs(change), exponent_), change);
}

double DamperLaw::solve(double before, double now, double free_after, double compliance,
                        std::span<const double>) const {
  const double change = free_after - before;
  const double right = std::abs(change);
  if (!(right > 0)) return 0;
  if (!(compliance > 0)) return force(before, now, free_after);
  double size = 0;
  if (exponent_ >= 1) {  // |change| = y + compliance strength y^a
    const double y = root_of(compliance * strength_, exponent_, 1, right);
    size = strength_ * std::pow(y, exponent_);
  } else {  // |change| = (N / strength)^(1/a) + compliance N
    size = root_of(std::pow(strength_, -1 / exponent_), 1 / exponent_, compliance, right);
  }
  return std::copysign(size, change);
}

}  // namespace pounding::interactions
