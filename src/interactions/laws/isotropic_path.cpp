#include "interactions/laws/isotropic_path.h"

#include <algorithm>

namespace pounding::interactions {

IsotropicPath::IsotropicPath(const Hysteresis& law) : stiffness_(law.first_slope()) {
  for (const bool positive : {false, true}) {
    const Skeleton& skeleton = positive ? law.positive : law.negative;
    Side& side = sides_[positive ? 1 : 0];
    for (const SkeletonBreak& corner : skeleton.breaks) {
      const double way = side.points.empty() ? 0 : corner.elongation - corner.force / stiffness_;
      side.points.push_back({way, corner.force});
    }
    side.last_slope = skeleton.last_slope / (1 - skeleton.last_slope / stiffness_);
  }
}

double IsotropicPath::Side::strength(double way) const {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point& a = points[i - 1];
    const Point& b = points[i];
    if (way > b.way) continue;
    return a.force + (b.force - a.force) * (way - a.way) / (b.way - a.way);
  }
  return points.back().force + last_slope * (way - points.back().way);
}

double IsotropicPath::return_to(const Side& side, double way, double trial) const {
  double strength = side.strength(way);
  for (const Point& point : side.points) {
    if (point.way <= way) continue;
    const double slope = (point.force - strength) / (point.way - way);
    const double on = way + (trial - strength) / (stiffness_ + slope);
    if (on <= point.way) return on;
    trial -= stiffness_ * (point.way - way);
    way = point.way;
    strength = point.force;
  }
  return way + (trial - strength) / (stiffness_ + side.last_slope);
}

HysteresisPath::State IsotropicPath::follow(double /*from*/, double to, std::span<double> memory,
                                            double /*strength*/) const {
  double& plastic = memory[0];
  double& way = memory[1];
  double force = stiffness_ * (to - plastic);
  const double sign = force < 0 ? -1 : 1;
  const Side& side = sides_[force < 0 ? 0 : 1];
  if (sign * force > side.strength(way)) {
    const double gone = return_to(side, way, sign * force);
    plastic += sign * (gone - way);
    way = gone;
    force = sign * std::max(0.0, side.strength(way));
  }
  return {force, force * force / (2 * stiffness_)};
}

}  // namespace pounding::interactions
