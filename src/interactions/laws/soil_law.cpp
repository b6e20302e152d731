#include "interactions/laws/soil_law.h"

namespace pounding::interactions {

double SoilLaw::inner_rate(double share) const {
  const double c1 = impedance_.inner_dashpot;
  double slip = 1;
  if (impedance_.inner_mass > 0) slip += c1 * share * time_step_ / (2 * impedance_.inner_mass);
  if (impedance_.inner_stiffness > 0) {
    slip += 2 * c1 / (share * time_step_ * impedance_.inner_stiffness);
  }
  return c1 / slip;
}

double SoilLaw::lag(double share, std::span<const double> memory) const {
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

double SoilLaw::offset(double before, double now, double share,
                       std::span<const double> memory) const {
  const double inertia =
      -2 * impedance_.mass * ((now - before) / (share * time_step_ * time_step_));
  return memory.empty() ? inertia : inertia - inner_rate(share) * lag(share, memory);
}

double SoilLaw::force(double before, double now, double after,
                      std::span<const double> memory) const {
  return rate() * (after - before) + offset(before, now, 1, memory);
}

double SoilLaw::solve(double before, double now, double free_after, double compliance,
                      std::span<const double> memory) const {
  return (rate() * (free_after - before) + offset(before, now, 1, memory)) /
         (1 + compliance * rate());
}

double SoilLaw::energy(double now, double after, std::span<const double> memory) const {
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
