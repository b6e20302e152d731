#include "dynamics/stable_time_step.h"

#include <cmath>

namespace pounding {

double damping_ratio(const Rayleigh& damping, double omega) {
  return damping.alpha / (2 * omega) + damping.beta * omega / 2;
}

double stable_time_step(const Rayleigh& damping, double omega_max) {
  const double ratio = damping_ratio(damping, omega_max);
  return 2 / (omega_max * (std::sqrt(1 + ratio * ratio) + ratio));
}

double energy_margin(const Rayleigh& damping, double omega_max, double time_step) {
  const double square = omega_max * omega_max;
  return 1 - time_step / 2 * (damping.alpha + damping.beta * square) -
         time_step * time_step / 4 * square;
}

double round_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 5);
  return std::floor(value / unit) * unit;
}

}  // namespace pounding
