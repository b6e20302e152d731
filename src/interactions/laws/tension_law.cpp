#include "interactions/laws/tension_law.h"

#include <algorithm>
#include <cmath>

namespace pounding::interactions {
namespace {

/// Positive root of a x^2 - b x - c = 0 with a > 0, c >= 0.
double positive_root(double a, double b, double c) {
  const double root = std::sqrt(b * b + 4 * a * c);
  return b >= 0 ? (b + root) / (2 * a) : 2 * c / (root - b);
}

}  // namespace

double TensionLaw::energy(double now, double after, std::span<const double>) const {
  return stiffness_ * std::max(0.0, now - slack_) * std::max(0.0, after - slack_) / 2;
}

double TensionLaw::force(double before, double now, double after, std::span<const double>) const {
  return stretched_force(before - slack_, now - slack_, after - slack_);
}

double TensionLaw::solve(double before, double now, double free_after, double compliance,
                         std::span<const double>) const {
  return solve_stretched(before - slack_, now - slack_, free_after - slack_, compliance);
}

double TensionLaw::stretched_force(double before, double now, double after) const {
  if (now <= 0) return 0;
  double share = before > 0 ? 1 : 0;
  if ((before > 0) != (after > 0) && before != after) {
    share = (std::max(0.0, after) - std::max(0.0, before)) / (after - before);
  }
  return std::max(0.0, stiffness_ * now * share + damping_rate_ * (after - before));
}

double TensionLaw::solve_stretched(double before, double now, double free_after,
                                   double compliance) const {
  if (now <= 0 || compliance <= 0) return stretched_force(before, now, free_after);
  const double pull = stiffness_ * now;
  const double r = compliance;
  const double a = 1 + r * damping_rate_;
  if (before > 0) {
    const double taut = (pull + damping_rate_ * (free_after - before)) / a;
    if (free_after - r * taut >= 0) return std::max(0.0, taut);
    // it goes slack: z = before - after
    const double z = positive_root(a, before - free_after, r * pull * before);
    return std::max(0.0, pull * before / z - damping_rate_ * z);
  }
  const double slack = damping_rate_ * (free_after - before) / a;
  if (free_after - r * slack < 0) return std::max(0.0, slack);
  // it was slack before and is taut after: z = after - before
  const double z = positive_root(a, free_after - before - r * pull, -r * pull * before);
  return z > 0 ? pull * (before + z) / z + damping_rate_ * z
               : std::min(pull, (free_after - before) / r);
}

}  // namespace pounding::interactions
