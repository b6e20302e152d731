#include "stability/resolved_motion.h"

#include <algorithm>
#include <numbers>

namespace pounding {
namespace {

constexpr double turn = 2 * std::numbers::pi;

}  // namespace

double ResolvedMotion::frequency() const {
  return omega / turn;
}

double ResolvedMotion::accurate_step() const {
  return omega > 0 ? resolved_angle / omega : std::numeric_limits<double>::infinity();
}

double ResolvedMotion::error(double step) const {
  return omega * step * omega * step / 24;
}

double resolved_frequency(double step) {
  return resolved_angle / step / turn;
}

ResolvedMotion resolved_motion(std::span<const double> frequencies, bool all, double omega_max,
                               double last) {
  if (omega_max <= turn * last) return {omega_max, true, {}};
  double highest = 0;
  bool reaches = all;
  for (const double frequency : frequencies) {
    if (frequency <= last) highest = std::max(highest, frequency);
    reaches = reaches || frequency > last;
  }
  if (reaches && highest > 0) return {turn * highest, true, {}};
  return {turn * last, false, {}};
}

ResolvedMotion faster(const ResolvedMotion& a, const ResolvedMotion& b) {
  return b.omega > a.omega ? b : a;
}

}  // namespace pounding
