#include "laws/dashpot_law.h"

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

/// Force N >= 0 [N] of a dashpot N = strength y^exponent whose rate is y = right - slope N, by
/// Newton's iteration on a convex function, from the side where it never overshoots. `strength` and
/// `exponent` above 0, `right` and `slope` not below.
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

}  // namespace

DamperLaw::DamperLaw(double strength, double exponent, double time_step)
    : exponent_(exponent), strength_(strength / std::pow(2 * time_step, exponent)) {}

double DamperLaw::force(double before, double /*now*/, double after, Memory) const {
  const double change = after - before;
  return std::copysign(strength_ * std::pow(std::abs(change), exponent_), change);
}

double DamperLaw::solve(double before, double /*now*/, double free_after, double compliance,
                        Memory) const {
  const double change = free_after - before;
  return std::copysign(power_force(strength_, exponent_, compliance, std::abs(change)), change);
}

SeriesLaw::SeriesLaw(double stiffness, double strength, double exponent, double time_step)
    : stiffness_(stiffness), strength_(strength), exponent_(exponent), time_step_(time_step) {}

double SeriesLaw::rate(double share) const {
  if (exponent_ != 1) return 0;
  return 1 / (2 * time_step_ / strength_ + 4 / (share * stiffness_));
}

double SeriesLaw::offset(double /*before*/, double /*now*/, double share, Memory memory) const {
  return memory[0] / (1 + stiffness_ * share * time_step_ / (2 * strength_));
}

double SeriesLaw::force(double before, double now, double after, Memory memory) const {
  return solve(before, now, after, 0, memory);
}

double SeriesLaw::solve(double before, double now, double free_after, double compliance,
                        Memory memory) const {
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

double SeriesLaw::energy(double /*now*/, double /*after*/, Memory memory) const {
  return memory[0] * memory[0] / (2 * stiffness_);
}

void SeriesLaw::remember(double before, double now, double after, double /*share*/,
                         std::span<double> memory) const {
  memory[0] = 2 * force(before, now, after, memory) - memory[0];
  memory[1] = 1;
}

double SoilLaw::inner_rate(double share) const {
  const double c1 = impedance_.inner_dashpot;
  double slip = 1;
  if (impedance_.inner_mass > 0) slip += c1 * share * time_step_ / (2 * impedance_.inner_mass);
  if (impedance_.inner_stiffness > 0) {
    slip += 2 * c1 / (share * time_step_ * impedance_.inner_stiffness);
  }
  return c1 / slip;
}

double SoilLaw::lag(double share, Memory memory) const {
  double lag = impedance_.inner_mass > 0 ? memory[0] : 0;
  if (impedance_.inner_stiffness > 0) {
    lag -= 2 * memory.back() / (share * time_step_ * impedance_.inner_stiffness);
  }
  return lag;
}

double SoilLaw::rate(double share) const {
  return (impedance_.dashpot + inner_rate(share)) / (2 * time_step_) +
         impedance_.mass / (share * time_step_ * time_step_);
}

double SoilLaw::offset(double before, double now, double share, Memory memory) const {
  const double inertia =
      -2 * impedance_.mass * ((now - before) / (share * time_step_ * time_step_));
  return memory.empty() ? inertia : inertia - inner_rate(share) * lag(share, memory);
}

double SoilLaw::force(double before, double now, double after, Memory memory) const {
  return rate() * (after - before) + offset(before, now, 1, memory);
}

double SoilLaw::solve(double before, double now, double free_after, double compliance,
                      Memory memory) const {
  return (rate() * (free_after - before) + offset(before, now, 1, memory)) /
         (1 + compliance * rate());
}

double SoilLaw::energy(double now, double after, Memory memory) const {
  const double mat = (after - now) / time_step_;
  const double inner = impedance_.inner_mass > 0 ? memory[0] : 0;
  const double moving = (impedance_.mass * mat * mat + impedance_.inner_mass * inner * inner) / 2;
  if (!(impedance_.inner_stiffness > 0)) return moving;
  return moving + memory.back() * memory.back() / (2 * impedance_.inner_stiffness);
}

std::size_t SoilLaw::memory_size() const {
  if (!(impedance_.inner_dashpot > 0)) return 0;
  return (impedance_.inner_mass > 0 ? 1U : 0U) + (impedance_.inner_stiffness > 0 ? 1U : 0U);
}

void SoilLaw::remember(double before, double /*now*/, double after, double share,
                       std::span<double> memory) const {
  if (memory.empty()) return;
  const double mean = (after - before) / (2 * time_step_);
  const double gap = mean - lag(share, memory);
  if (impedance_.inner_stiffness > 0) {
    memory.back() = 2 * inner_rate(share) * gap - memory.back();
  }
  if (impedance_.inner_mass > 0) {
    memory[0] += share * time_step_ / impedance_.inner_mass * inner_rate(share) * gap;
  }
}

}  // namespace pounding::interactions
