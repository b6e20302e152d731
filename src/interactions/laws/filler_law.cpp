#include "interactions/laws/filler_law.h"

#include <algorithm>

namespace pounding::interactions {

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

double FillerLaw::full(double now, std::span<const double> memory) const {
  return spring_.tangent() * std::max(0.0, now - memory[1]);
}

double FillerLaw::force(double before, double now, double after,
                        std::span<const double> memory) const {
  const double crushed = memory[1];
  if (before > crushed) return spring_.force(before - crushed, now - crushed, after - crushed);
  return after >= before ? full(now, memory) : 0;
}

double FillerLaw::solve(double before, double now, double free_after, double compliance,
                        std::span<const double> memory) const {
  const double crushed = memory[1];
  if (before > crushed) {
    return spring_.solve(before - crushed, now - crushed, free_after - crushed, compliance);
  }
  const double most = full(now, memory);
  if (compliance <= 0) return free_after >= before ? most : 0;
  return std::clamp((free_after - before) / compliance, 0.0, most);
}

double FillerLaw::energy(double now, double after, std::span<const double> memory) const {
  return spring_.energy(now - memory[0], after - memory[0]);
}

void FillerLaw::remember(double /*before*/, double /*now*/, double /*after*/, double /*share*/,
                         std::span<double> memory) const {
  memory[0] = memory[1];
}

}  // namespace pounding::interactions
