#include "soil/impedance.h"

#include <algorithm>
#include <cmath>

namespace pounding {

std::complex<double> Impedance::at(double circular_frequency) const {
  const std::complex<double> i_omega(0, circular_frequency);
  std::complex<double> inner = 0;
  if (inner_dashpot > 0 && circular_frequency != 0) {
    std::complex<double> slip = 1;
    if (inner_mass > 0) slip += inner_dashpot / (i_omega * inner_mass);
    if (inner_stiffness > 0) slip += i_omega * (inner_dashpot / inner_stiffness);
    inner = inner_dashpot / slip;
  }
  return stiffness + i_omega * (dashpot + inner + i_omega * mass);
}

double HalfSpace::longitudinal_velocity() const {
  constexpr double largest_ratio = 2.5;
  return shear_velocity * std::min(largest_ratio, std::sqrt(2 * (1 - poisson) / (1 - 2 * poisson)));
}

Impedance softening(double stiffness, double share, double turn, double length, double velocity) {
  const double time = length / (velocity * std::sqrt(turn));
  Impedance mode;
  mode.stiffness = stiffness;
  mode.inner_dashpot = share * stiffness * time;
  mode.inner_mass = mode.inner_dashpot * time;
  return mode;
}

}  // namespace pounding
