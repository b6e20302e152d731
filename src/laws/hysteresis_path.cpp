#include "laws/hysteresis_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pounding::interactions {
namespace {

constexpr double on_envelope = 4e-16;  ///< above it, in round-off

/// Path of kinematic hardening: a spring of the last slope and, in parallel, springs each in series
/// with a slider, one for each break of the skeleton,
///
///     F = r e + sum_i q_i,     q_i = k_i (e - p_i) within s [-Q_i-, Q_i+]
///
/// s the strength, k_i the slope lost at the break and Q_i = k_i times its elongation. Slopes must
/// not grow, and be the same in both directions.
class SliderPath final : public HysteresisPath {
 public:
  explicit SliderPath(const Hysteresis& law) : last_slope_(law.positive.last_slope) {
    const auto& plus = law.positive.breaks;
    const auto& minus = law.negative.breaks;
    double slope = law.first_slope();
    for (std::size_t i = 0; i < plus.size(); ++i) {
      const double next = i + 1 < plus.size() ? (plus[i + 1].force - plus[i].force) /
                                                    (plus[i + 1].elongation - plus[i].elongation)
                                              : last_slope_;
      const double lost = slope - next;
      sliders_.push_back({lost, lost * plus[i].elongation, -lost * minus[i].elongation});
      slope = next;
    }
  }

  /// p_i of each slider.
  std::size_t memory_size() const override { return sliders_.size(); }
  State follow(double /*from*/, double to, std::span<double> memory,
               double strength) const override {
    State state{last_slope_ * to, last_slope_ * to * to / 2};
    for (std::size_t i = 0; i < sliders_.size(); ++i) {
      const Slider& slider = sliders_[i];
      double force = slider.stiffness * (to - memory[i]);
      if (force > strength * slider.most || force < strength * slider.least) {
        force = std::clamp(force, strength * slider.least, strength * slider.most);
        memory[i] = to - force / slider.stiffness;
      }
      state.force += force;
      if (slider.stiffness > 0) state.stored += force * force / (2 * slider.stiffness);
    }
    return state;
  }

 private:
  struct Slider {
    double stiffness = 0;
    double most = 0;   ///< Q+
    double least = 0;  ///< -Q-
  };
  std::vector<Slider> sliders_;
  double last_slope_;
};

/// Path of isotropic hardening, or softening: with the plastic elongation p and the length k of the
/// way that it has gone,
///
///     F = k0 (e - p),   -R-(k) <= F <= R+(k)
///
/// R the force of the skeleton at that much plastic elongation.
class IsotropicPath final : public HysteresisPath {
 public:
  explicit IsotropicPath(const Hysteresis& law) : stiffness_(law.first_slope()) {
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

  /// p and k.
  std::size_t memory_size() const override { return 2; }
  State follow(double /*from*/, double to, std::span<double> memory,
               double /*strength*/) const override {
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

 private:
  struct Point {
    double way = 0;    ///< k [m]
    double force = 0;  ///< R [N]
  };
  struct Side {
    std::vector<Point> points;
    double last_slope = 0;  ///< dR/dk beyond them

    double strength(double way) const;
  };
  /// The way k at which the force `trial` - k0 (k - way) is R.
  double return_to(const Side& side, double way, double trial) const {
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

  double stiffness_;
  std::array<Side, 2> sides_;  ///< of negative and of positive forces
};

double IsotropicPath::Side::strength(double way) const {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point& a = points[i - 1];
    const Point& b = points[i];
    if (way > b.way) continue;
    return a.force + (b.force - a.force) * (way - a.way) / (b.way - a.way);
  }
  return points.back().force + last_slope * (way - points.back().way);
}

/// Path that unloads from the skeleton to where no force acts and goes from there to the farthest
/// point (E, F) that the skeleton of the other side has reached, its first break at least:
///
///     F = min( k_u (e - p), envelope ),   k_u = max( k0 (k_s / k0)^a, least ),   k_s = F / E
///
/// in the direction of the force; p is where it would vanish. The envelope is the line from where
/// the side was entered to its farthest point, by way of the pinch where there is one, and the
/// skeleton beyond. a = 1 points to the origin; straight, k_u is the slope of the line that joins
/// the farthest points of both sides. A side that carries nothing is a gap. With an elastic part in
/// series k_u and the pinch are those of the rest, F the force and e the elongation of both.
///
/// Strength deteriorates at each passage through no force, by the part b of what is left,
/// b = (D / (L - sum D))^c, with D the energy lost since the last one, L the lasting energy.
class PeakPath final : public HysteresisPath {
 public:
  explicit PeakPath(const Hysteresis& law) : law_(law), stiffness_(law.first_slope()) {
    if (law_.rule == HystereticRule::origin) law_.unloading_exponent = 1;
  }

  std::size_t memory_size() const override { return numbers; }
  State follow(double from, double to, std::span<double> memory,
               double /*strength*/) const override {
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

 private:
  /// Places in the memory. Of a pair the first is of negative forces.
  enum Number : std::size_t {
    side_now,       ///< -1, 1; 0 before the first motion
    plastic,        ///< p
    entered_minus,  ///< e at which the side was entered
    entered_plus,
    beyond_minus,  ///< E less the elongation of the first break
    beyond_plus,
    reached,      ///< farthest since then, in its direction: up to there it loads as it unloads
    weakened,     ///< part of the strength that is gone
    lost_before,  ///< energy lost up to the last passage
    lost_since,   ///< and since then, with what is stored
    numbers
  };

  const Skeleton& skeleton(int side) const { return side > 0 ? law_.positive : law_.negative; }
  bool carries(int side) const { return !skeleton(side).breaks.empty(); }
  double first_break(int side) const { return skeleton(side).breaks.front().elongation; }
  double farthest(int side, std::span<const double> memory) const {
    return first_break(side) + memory[side > 0 ? beyond_plus : beyond_minus];
  }
  double on_skeleton(int side, double elongation, std::span<const double> memory) const {
    return (1 - memory[weakened]) * skeleton_force(skeleton(side), stiffness_, elongation);
  }
  bool goes_straight(std::span<const double> memory) const {
    if (law_.rule == HystereticRule::straight) return true;
    if (law_.rule != HystereticRule::bending) return false;
    for (const int side : {-1, 1}) {
      const auto& breaks = skeleton(side).breaks;
      if (breaks.size() > 1 && farthest(side, memory) > breaks[1].elongation) return false;
    }
    return true;
  }
  double unloading(int side, std::span<const double> memory) const {
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
    const double own = own_stiffness(stiffness_);
    const double power = law_.unloading_exponent == 0
                             ? own
                             : own * std::pow(own_stiffness(secant) / own, law_.unloading_exponent);
    const double rule = std::max(power, law_.unloading_least * own);
    return std::max(law_.flexibility == 0 ? rule : 1 / (1 / rule + law_.flexibility), line);
  }
  /// Stiffness without the elastic part in series.
  double own_stiffness(double stiffness) const {
    return law_.flexibility == 0 ? stiffness : 1 / (1 / stiffness - law_.flexibility);
  }
  double envelope(int side, double elongation, std::span<const double> memory) const {
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
  /// Elongation of the pinch; not beyond the one at which the side was entered if there is none.
  double pinch(int side, std::span<const double> memory) const {
    const double entered = side * memory[side > 0 ? entered_plus : entered_minus];
    const bool beyond = memory[side > 0 ? beyond_plus : beyond_minus] > 0;
    if (law_.rule != HystereticRule::pinching || !beyond) return entered;
    const double far = farthest(side, memory);
    const double bent = law_.flexibility * on_skeleton(side, far, memory);  // elastic part
    return entered + law_.pinch_elongation * (far - bent - entered) + law_.pinch_force * bent;
  }
  double next_corner(int side, double elongation, std::span<const double> memory) const {
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
  void load(int side, double from, double to, std::span<double> memory) const {
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
  void pass_through_zero(int side, std::span<double> memory) const {
    memory[side_now] = side;
    memory[side > 0 ? entered_plus : entered_minus] = memory[plastic];
    memory[reached] = side * memory[plastic];
    if (std::isinf(law_.lasting_energy)) return;
    const double left = law_.lasting_energy - memory[lost_before];
    memory[lost_before] += memory[lost_since];
    const double part =
        left > memory[lost_since]
            ? std::pow(std::max(0.0, memory[lost_since]) / left, law_.deterioration_exponent)
            : 1;
    memory[weakened] += (1 - memory[weakened]) * part;
    memory[lost_since] = 0;
  }

  Hysteresis law_;
  double stiffness_;
};

}  // namespace

double skeleton_force(const Skeleton& skeleton, double first_slope, double elongation) {
  if (skeleton.breaks.empty()) return 0;
  if (elongation <= skeleton.breaks.front().elongation) return first_slope * elongation;
  for (std::size_t i = 1; i < skeleton.breaks.size(); ++i) {
    const SkeletonBreak& a = skeleton.breaks[i - 1];
    const SkeletonBreak& b = skeleton.breaks[i];
    if (elongation > b.elongation) continue;
    return a.force +
           (b.force - a.force) * (elongation - a.elongation) / (b.elongation - a.elongation);
  }
  const SkeletonBreak& last = skeleton.breaks.back();
  return last.force + skeleton.last_slope * (elongation - last.elongation);
}

std::unique_ptr<HysteresisPath> make_path(const Hysteresis& law) {
  if (law.rule == HystereticRule::kinematic) return std::make_unique<SliderPath>(law);
  if (law.rule == HystereticRule::isotropic) return std::make_unique<IsotropicPath>(law);
  return std::make_unique<PeakPath>(law);
}

}  // namespace pounding::interactions
