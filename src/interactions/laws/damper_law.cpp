#include "interactions/laws/damper_law.h"

#include <cmath>

#include "interactions/laws/power_root.h"

namespace pounding::interactions {

DamperLaw::DamperLaw(double strength, double exponent, double time_step)
    : exponent_(exponent), strength_(strength / std::pow(2 * time_step, exponent)) {}

double DamperLaw::force(double before, double /*now*/, double after,
                        std::span<const double>) const {
  const double change = after - before;
  return std::copysign(strength_ * std::pow(std::abs(change), exponent_), change);
}

double DamperLaw::solve(double before, double /*now*/, double free_after, double compliance,
                        std::span<const double>) const {
  const double change = free_after - before;
  return std::copysign(power_force(strength_, exponent_, compliance, std::abs(change)), change);
}

}  // namespace pounding::interactions
