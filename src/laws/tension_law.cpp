#include "laws/tension_law.h"

#include <algorithm>
#include <cmath>

namespace pounding::interactions {
namespace {

/// Positive root of a x^2 - b x - c = 0 with a > 0, c >= 0.
double positive_root(double a, double b, double c) {
  const double root = std::sqrt(b * b + 4 * a * c);
  return b >= 0 ? (b + root) / (2 * a) : 2 * c / (root - b);
}

}  // namespace

double TensionLaw::energy(double now, double after, Memory memory) const {
  const double slack = this->slack(memory);
  double held = stiffness_ * std::max(0.0, now - slack) * std::max(0.0, after - slack) / 2;
  for (std::size_t i = 0; i < branches_.size() && !memory.empty(); ++i) {
    held += memory[i] * memory[i] / (2 * branches_[i].stiffness);
  }
  return held;
}

double TensionLaw::force(double before, double now, double after, Memory memory) const {
  const double slack = this->slack(memory);
  return stretched_force(damping(1, memory), before - slack, now - slack, after - slack);
}

double TensionLaw::solve(double before, double now, double free_after, double compliance,
                         Memory memory) const {
  const double slack = this->slack(memory);
  return solve_stretched(damping(1, memory), before - slack, now - slack, free_after - slack,
                         compliance);
}

TensionLaw::Damping TensionLaw::damping(double share, Memory memory) const {
  Damping all{damping_rate_, 0};
  for (std::size_t i = 0; i < branches_.size() && !memory.empty(); ++i) {
    const double kept = 1 + branches_[i].rate * share * time_step_ / 2;
    all.rate += share * branches_[i].stiffness / (4 * kept);
    all.offset += memory[i] / kept;
  }
  return all;
}

double TensionLaw::spring_force(double before, double now, double after) const {
  double share = before > 0 ? 1 : 0;
  if ((before > 0) != (after > 0) && before != after) {
    share = (std::max(0.0, after) - std::max(0.0, before)) / (after - before);
  }
  return stiffness_ * now * share;
}

double TensionLaw::stretched_force(const Damping& damping, double before, double now,
                                   double after) const {
  if (now <= 0) return 0;
  return std::max(
      0.0, spring_force(before, now, after) + damping.rate * (after - before) + damping.offset);
}

double TensionLaw::solve_stretched(const Damping& damping, double before, double now,
                                   double free_after, double compliance) const {
  if (now <= 0 || compliance <= 0) return stretched_force(damping, before, now, free_after);
  const double pull = stiffness_ * now;
  const double r = compliance;
  const double a = 1 + r * damping.rate;
  const double way = free_after - before - r * damping.offset;  // e_{n+1} - e_{n-1} of the branches
  const double damped = damping.rate * (free_after - before) + damping.offset;
  if (before > 0) {
    const double taut = (pull + damped) / a;
    if (free_after - r * taut >= 0) return std::max(0.0, taut);
    // it goes slack: z = before - after
    const double z = positive_root(a, -way, r * pull * before);
    return std::max(0.0, pull * before / z - damping.rate * z + damping.offset);
  }
  const double slack = damped / a;
  if (free_after - r * slack < 0) return std::max(0.0, slack);
  // it was slack before and is taut after: z = after - before
  const double z = positive_root(a, way - r * pull, -r * pull * before);
  const double tension = z > 0 ? pull * (before + z) / z + damping.rate * z + damping.offset
                               : std::min(pull + damping.offset, (free_after - before) / r);
  return std::max(0.0, tension);
}

void TensionLaw::rest(double now, std::span<double> memory) const {
  if (!memory.empty()) memory.back() = std::max(0.0, now - slack_) * (1 - 1 / at_rest_);
}

void TensionLaw::remember(double before, double now, double after, double share,
                          std::span<double> memory) const {
  if (memory.empty()) return;
  const double slack = this->slack(memory);
  double way = 0;  // 2 dt r'
  if (now > slack) {
    const Damping all = damping(share, memory);
    const double spring = spring_force(before - slack, now - slack, after - slack);
    way = std::max(after - before, -(spring + all.offset) / all.rate);
  }
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    const double turn = branches_[i].rate * share * time_step_ / 2;
    const double grown = share * branches_[i].stiffness * way / 2;
    memory[i] = (memory[i] * (1 - turn) + grown) / (1 + turn);
  }
}

FillerLaw::FillerLaw(const Filler& filler, double thickness, double area)
    : points_(1), spring_(filler.stiffness(thickness, area), 0) {
  for (const Filler::Point& point : filler.table) {
    points_.push_back({point.strain * thickness, point.pressure * area});
  }
}

double FillerLaw::first_loading(double compression) const {
  if (compression <= 0) return 0;
  std::size_t next = 1;
  while (next + 1 < points_.size() && points_[next].compression < compression) ++next;
  const Point& low = points_[next - 1];
  const Point& high = points_[next];
  const double slope = (high.force - low.force) / (high.compression - low.compression);
  return low.force + slope * (compression - low.compression);
}

void FillerLaw::yield(double now, double /*kept*/, std::span<double> memory) const {
  memory[1] = std::max(memory[0], now - first_loading(now) / spring_.tangent());
}

double FillerLaw::full(double now, Memory memory) const {
  return spring_.tangent() * std::max(0.0, now - memory[1]);
}

double FillerLaw::force(double before, double now, double after, Memory memory) const {
  const double crushed = memory[1];
  if (before > crushed) return spring_.force(before - crushed, now - crushed, after - crushed);
  return after >= before ? full(now, memory) : 0;
}

double FillerLaw::solve(double before, double now, double free_after, double compliance,
                        Memory memory) const {
  const double crushed = memory[1];
  if (before > crushed) {
    return spring_.solve(before - crushed, now - crushed, free_after - crushed, compliance);
  }
  const double most = full(now, memory);
  if (compliance <= 0) return free_after >= before ? most : 0;
  return std::clamp((free_after - before) / compliance, 0.0, most);
}

double FillerLaw::energy(double now, double after, Memory memory) const {
  return spring_.energy(now - memory[0], after - memory[0]);
}

void FillerLaw::remember(double /*before*/, double /*now*/, double /*after*/, double /*share*/,
                         std::span<double> memory) const {
  memory[0] = memory[1];
}

}  // namespace pounding::interactions
