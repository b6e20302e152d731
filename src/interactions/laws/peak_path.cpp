#include "interactions/laws/peak_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding::interactions {
namespace {

constexpr double on_envelope = 4e-16;  ///< above it, in round-off

}  // namespace

PeakPath::PeakPath(const Hysteresis& law) : law_(law), stiffness_(law.first_slope()) {
  if (law_.rule == HystereticRule::origin) law_.unloading_exponent = 1;
}

bool PeakPath::goes_straight(std::span<const double> memory) const {
  if (law_.rule == HystereticRule::straight) return true;
  if (law_.rule != HystereticRule::bending) return false;
  for (const int side : {-1, 1}) {
    const auto& breaks = skeleton(side).breaks;
    if (breaks.size() > 1 && farthest(side, memory) > breaks[1].elongation) return false;
  }
  return true;
}

double PeakPath::unloading(int side, std::span<const double> memory) const {
  const bool straight =
      law_.rule == HystereticRule::straight || law_.rule == HystereticRule::bending;
  const bool untouched =
      memory[weakened] == 0 && memory[beyond_minus] == 0 && memory[beyond_plus] == 0;
  if (untouched) return stiffness_;
  const double far = farthest(side, memory);
  const double force = on_skeleton(side, far, memory);
  double line = 0;
  if (straight) {
    const double other = farthest(-side, memory);
    line = (force + on_skeleton(-side, other, memory)) / (far + other);
    if (goes_straight(memory)) return line;
  }
  const bool fresh = memory[weakened] == 0 && memory[side > 0 ? beyond_plus : beyond_minus] == 0;
  const double secant = fresh ? stiffness_ : force / far;
  const double power = law_.unloading_exponent == 0
                           ? stiffness_
                           : stiffness_ * std::pow(secant / stiffness_, law_.unloading_exponent);
  return std::max({power, line, law_.unloading_least * stiffness_});
}

double PeakPath::pinch(int side, std::span<const double> memory) const {
  const double entered = side * memory[side > 0 ? entered_plus : entered_minus];
  const bool beyond = memory[side > 0 ? beyond_plus : beyond_minus] > 0;
  if (law_.rule != HystereticRule::pinching || !beyond) return entered;
  return entered + law_.pinch_elongation * (farthest(side, memory) - entered);
}

double PeakPath::envelope(int side, double elongation, std::span<const double> memory) const {
  const double far = farthest(side, memory);
  if (elongation >= far) return on_skeleton(side, elongation, memory);
  const double entered = side * memory[side > 0 ? entered_plus : entered_minus];
  if (elongation <= entered) return 0;
  const double most = on_skeleton(side, far, memory);
  const double corner = pinch(side, memory);
  const double pinched = law_.pinch_force * most;
  if (elongation <= corner) return pinched * (elongation - entered) / (corner - entered);
  const double start = corner > entered ? pinched : 0;
  return start + (most - start) * (elongation - corner) / (far - corner);
}

double PeakPath::next_corner(int side, double elongation, std::span<const double> memory) const {
  double next = std::numeric_limits<double>::infinity();
  const auto look = [&](double corner) {
    if (corner > elongation) next = std::min(next, corner);
  };
  look(farthest(side, memory));
  look(pinch(side, memory));
  look(memory[reached]);
  for (const SkeletonBreak& corner : skeleton(side).breaks) look(corner.elongation);
  return next;
}

void PeakPath::load(int side, double from, double to, std::span<double> memory) const {
  const double vanish = side * memory[plastic];
  double at = std::max(from, vanish);
  while (at < to) {
    const double next = std::min(to, next_corner(side, at, memory));
    const double stiffness = unloading(side, memory);
    const double begin = stiffness * (at - side * memory[plastic]);
    const double trial = stiffness * (next - side * memory[plastic]);
    const double low = envelope(side, at, memory);
    const double high = envelope(side, next, memory);
    double work = (begin + trial) / 2 * (next - at);
    if (next > memory[reached] && trial > high * (1 + on_envelope)) {
      const double slope = (high - low) / (next - at);
      const double until =
          stiffness > slope ? std::clamp((low - begin) / (stiffness - slope), 0.0, next - at) : 0;
      const double meets = begin + stiffness * until;
      work = (begin + meets) / 2 * until + (meets + high) / 2 * (next - at - until);
      const double far = farthest(side, memory);
      if (next > far) memory[side > 0 ? beyond_plus : beyond_minus] = next - first_break(side);
      const double after = unloading(side, memory);
      memory[plastic] = side * (next - (after > 0 ? high / after : 0));
    }
    memory[lost_since] += work;
    memory[reached] = std::max(memory[reached], next);
    at = next;
  }
}

void PeakPath::pass_through_zero(int side, std::span<double> memory) const {
  memory[side_now] = side;
  memory[side > 0 ? entered_plus : entered_minus] = memory[plastic];
  memory[reached] = side * memory[plastic];
  if (std::isinf(law_.lasting_energy)) return;
  const double left = law_.lasting_energy - memory[lost_before];
  memory[lost_before] += memory[lost_since];
  const double part = left > memory[lost_since] ? std::pow(std::max(0.0, memory[lost_since]) / left,
                                                           law_.deterioration_exponent)
                                                : 1;
  memory[weakened] += (1 - memory[weakened]) * part;
  memory[lost_since] = 0;
}

HysteresisPath::State PeakPath::follow(double from, double to, std::span<double> memory,
                                       double /*strength*/) const {
  const int direction = to > from ? 1 : -1;
  if (memory[side_now] == 0 && to != from) {
    memory[side_now] = carries(direction) ? direction : -direction;
  }
  int side = static_cast<int>(memory[side_now]);
  if (side == 0) return {};
  if (direction != side && to != from) {
    const double stiffness = unloading(side, memory);
    const double before = std::max(0.0, stiffness * side * (from - memory[plastic]));
    const double after = std::max(0.0, stiffness * side * (to - memory[plastic]));
    if (stiffness > 0) memory[lost_since] -= (before * before - after * after) / (2 * stiffness);
    if (side * (to - memory[plastic]) < 0 && carries(direction)) {
      const double start = memory[plastic];
      pass_through_zero(direction, memory);
      side = direction;
      load(side, side * start, side * to, memory);
    }
  } else {
    load(side, side * from, side * to, memory);
  }
  const double stiffness = unloading(side, memory);
  const double force = std::max(0.0, stiffness * side * (to - memory[plastic]));
  return {side * force, stiffness > 0 ? force * force / (2 * stiffness) : 0};
}

}  // namespace pounding::interactions
