#include "scene/soil.h"

#include <algorithm>

#include "elements/point.h"

namespace pounding {
namespace {

/// Impedances of a half-space along and about the axes.
std::vector<DirectedImpedance> along_axes(const Soil& soil, const Footprint& footprint) {
  Impedances modes = impedances_of(soil.ground, footprint);
  if (!soil.frequency_dependence) {
    modes = without_frequency_dependence(modes, soil.ground, footprint);
  }
  std::vector<DirectedImpedance> impedances(modes.size());
  for (std::size_t c = 0; c < modes.size(); ++c) {
    impedances[c].motion[c] = 1;
    impedances[c].impedance = modes[c];
  }
  return impedances;
}

}  // namespace

std::array<double, 6> over_arm(std::span<const double> motion, const Vector3& arm) {
  const auto centre = motion_at(arm);
  std::array<double, 6> of_node{};
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t i = 0; i < 6; ++i) of_node[i] += motion[c] * centre[c][i];
  }
  return of_node;
}

std::array<double, 2> sides_of(const Soil& soil, const MatOutline& outline) {
  if (soil.sides) return *soil.sides;
  if (!soil.disk) return outline.sides;
  const double diameter = std::min(outline.sides[0], outline.sides[1]);
  return {diameter, diameter};
}

Foundation foundation_of(const Soil& soil, const MatOutline& outline) {
  Foundation foundation;
  foundation.centre = outline.centre;
  Vector3 arm{};
  for (std::size_t d = 0; d < 3; ++d) arm[d] = outline.centre[d] - outline.node[d];
  if (soil.fitted) {
    foundation.impedances = soil.fitted->parts;
  } else {
    foundation.footprint = {soil.disk, sides_of(soil, outline), soil.embedment};
    foundation.impedances = along_axes(soil, foundation.footprint);
  }
  for (const DirectedImpedance& part : foundation.impedances) {
    foundation.springs.push_back(
        {over_arm(part.motion, arm), part.impedance.stiffness, part.impedance.dashpot});
  }
  return foundation;
}

}  // namespace pounding
