#include "interactions/laws/soil_law.h"

namespace pounding::interactions {

double SoilLaw::inner_rate(double share) const {
  if (!(impedance_.inner_mass > 0)) return 0;
  const double c1 = impedance_.inner_dashpot;
  return c1 / (1 + c1 * share * time_step_ / (2 * impedance_.inner_mass));
}

double SoilLaw::rate(double share) const {
  return (impedance_.dashpot + inner_rate(share)) / (2 * time_step_) +
         impedance_.mass / (share * time_step_ * time_step_);
}

double SoilLaw::offset(double before, double now, double share,
                       std::span<const double> memory) const {
  const double inertia =
      -2 * impedance_.mass * ((now - before) / (share * time_step_ * time_step_));
  return memory.empty() ? inertia : inertia - inner_rate(share) * memory[0];
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
  const double inner = memory.empty() ? 0 : memory[0];
  return (impedance_.mass * mat * mat + impedance_.inner_mass * inner * inner) / 2;
}

void SoilLaw::remember(double before, double /*now*/, double after, double share,
                       std::span<double> memory) const {
  if (memory.empty()) return;
  const double mean = (after - before) / (2 * time_step_);
  memory[0] += share * time_step_ / impedance_.inner_mass * inner_rate(share) * (mean - memory[0]);
}

}  // namespace pounding::interactions
