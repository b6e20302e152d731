#include "interactions/laws/power_root.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding::interactions {
namespace {

constexpr int most_iterations = 200;

/// Root y of factor y^power + slope y = right with power >= 1, all others positive.
double root_of(double factor, double power, double slope, double right) {
  double y = std::min(right / slope, std::pow(right / factor, 1 / power));
  for (int i = 0; i < most_iterations; ++i) {
    const double raised = factor * std::pow(y, power);
    const double excess = raised + slope * y - right;
    const double next = y - excess / (power * raised / y + slope);
    if (!(next < y) || next <= 0) break;
    y = next;
  }
  return y;
}

}  // namespace

double power_force(double strength, double exponent, double slope, double right) {
  if (!(right > 0)) return 0;
  if (!(slope > 0)) return strength * std::pow(right, exponent);
  // right = y^(1/a) + slope strength y, y = N / strength: no power of the strength, which the
  // smallest exponents would take beyond all numbers
  const double force =
      exponent < 1 ? strength * root_of(1, 1 / exponent, slope * strength, right)
                   : strength * std::pow(root_of(slope * strength, exponent, 1, right), exponent);
  // The rate that is left is not turned round by round-off.
  return std::min(force, (1 - 2 * std::numeric_limits<double>::epsilon()) * (right / slope));
}

}  // namespace pounding::interactions
