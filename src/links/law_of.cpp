#include "links/law_of.h"

#include "links/tension_law.h"

namespace pounding {

std::unique_ptr<LinkLaw> law_of(const Region& region, double length, double beta,
                                double time_step) {
  const double stiffness = region.material.young * region.area / length;
  return std::make_unique<TensionLaw>(stiffness, beta * stiffness / (2 * time_step));
}

}  // namespace pounding
