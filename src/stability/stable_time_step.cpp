#include "stability/stable_time_step.h"

#include <cmath>

#include "system/mass_scaling.h"

namespace pounding {

double damping_ratio(const Rayleigh& damping, double omega) {
  return omega > 0 ? damping.alpha / (2 * omega) + damping.beta * omega / 2 : 0;
}

double stable_time_step(const Rayleigh& damping, double omega_max, double stiffening) {
  const double square = omega_max * omega_max;
  return critical_time_step(damping.alpha + damping.beta * square, stiffening * square);
}

double energy_margin(const Rayleigh& damping, double omega_max, double time_step,
                     double stiffening) {
  const double square = omega_max * omega_max;
  return 1 - time_step / 2 * (damping.alpha + damping.beta * square) -
         time_step * time_step / 4 * stiffening * square;
}

double round_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 5);
  return std::floor(value / unit) * unit;
}

}  // namespace pounding
