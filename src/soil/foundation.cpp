#include "soil/foundation.h"

#include "soil/rectangle.h"

namespace pounding {

Impedances impedances_of(const HalfSpace& soil, const Footprint& footprint) {
  return footprint.disk ? disk_impedances(soil, footprint.half_width())
                        : rectangle_impedances(soil, footprint.sides, footprint.embedment);
}

Impedances without_frequency_dependence(Impedances impedances, const HalfSpace& soil,
                                        const Footprint& footprint) {
  const double omega = soil.shear_velocity / footprint.half_width();
  for (Impedance& mode : impedances) {
    mode.dashpot = mode.at(omega).imag() / omega;
    mode.inner_dashpot = mode.inner_mass = mode.mass = 0;
  }
  return impedances;
}

}  // namespace pounding
