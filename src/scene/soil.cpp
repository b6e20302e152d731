#include "scene/soil.h"

#include <algorithm>

namespace pounding {

std::array<double, 2> sides_of(const Soil& soil, const MatPlace& place) {
  if (soil.sides) return *soil.sides;
  if (!soil.disk) return place.sides;
  const double diameter = std::min(place.sides[0], place.sides[1]);
  return {diameter, diameter};
}

Foundation foundation_of(const Soil& soil, const MatPlace& place) {
  Foundation foundation;
  foundation.footprint = {soil.disk, sides_of(soil, place), soil.embedment};
  foundation.centre = place.centre;
  for (std::size_t d = 0; d < 3; ++d) foundation.arm[d] = place.centre[d] - place.node[d];
  foundation.impedances = impedances_of(soil.ground, foundation.footprint);
  if (!soil.frequency_dependence) {
    foundation.impedances =
        without_frequency_dependence(foundation.impedances, soil.ground, foundation.footprint);
  }
  return foundation;
}

}  // namespace pounding
