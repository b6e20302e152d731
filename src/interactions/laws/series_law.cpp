#include "interactions/laws/series_law.h"

#include <cmath>

#include "interactions/laws/power_root.h"

namespace pounding::interactions {

SeriesLaw::SeriesLaw(double stiffness, double strength, double exponent, double time_step)
    : stiffness_(stiffness), strength_(strength), exponent_(exponent), time_step_(time_step) {}

double SeriesLaw::rate(double share) const {
  if (exponent_ != 1) return 0;
  return 1 / (2 * time_step_ / strength_ + 4 / (share * stiffness_));
}

double SeriesLaw::offset(double /*before*/, double /*now*/, double share,
                         std::span<const double> memory) const {
  return memory[0] / (1 + stiffness_ * share * time_step_ / (2 * strength_));
}

double SeriesLaw::force(double before, double now, double after,
                        std::span<const double> memory) const {
  return solve(before, now, after, 0, memory);
}

double SeriesLaw::solve(double before, double now, double free_after, double compliance,
                        std::span<const double> memory) const {
  const double share = share_of(memory);
  const double change = free_after - before;
  if (exponent_ == 1) {
    return (rate(share) * change + offset(before, now, share, memory)) /
           (1 + compliance * rate(share));
  }
  // y + 2 (N - Q-) / (d A) = (change - compliance N) / (2 dt)
  const double slope = 2 / (share * time_step_ * stiffness_) + compliance / (2 * time_step_);
  const double right =
      change / (2 * time_step_) + 2 * memory[0] / (share * time_step_ * stiffness_);
  return std::copysign(power_force(strength_, exponent_, slope, std::abs(right)), right);
}

double SeriesLaw::energy(double /*now*/, double /*after*/, std::span<const double> memory) const {
  return memory[0] * memory[0] / (2 * stiffness_);
}

void SeriesLaw::remember(double before, double now, double after, double /*share*/,
                         std::span<double> memory) const {
  memory[0] = 2 * force(before, now, after, memory) - memory[0];
  memory[1] = 1;
}

}  // namespace pounding::interactions
