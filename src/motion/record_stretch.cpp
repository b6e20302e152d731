#include "motion/record_stretch.h"

#include <algorithm>
#include <cmath>

namespace pounding::oscillator {
namespace {

/// Part of the largest |h^2 a| by which the velocity between two samples may exceed that at both:
/// an eighth of the change of an acceleration that is linear between them.
constexpr double between_samples = 0.25;

Stretch stretch_of(std::span<const double> acceleration, double h2, std::size_t first,
                   std::size_t last) {
  Stretch stretch{first, last, std::abs(h2 * acceleration[first]), 0, 0};
  double velocity = 0, low = 0, high = 0;
  for (std::size_t n = first + 1; n <= last; ++n) {
    const double a0 = h2 * acceleration[n - 1], a1 = h2 * acceleration[n];
    stretch.load = std::max(stretch.load, std::abs(a1));
    velocity += 0.5 * (a0 + a1);
    low = std::min(low, velocity);
    high = std::max(high, velocity);
  }
  const double beyond = between_samples * stretch.load;
  stretch.velocity = std::max(-low, high) + beyond;
  stretch.range = high - low + 2 * beyond;
  return stretch;
}

}  // namespace

std::vector<Stretch> stretches_of(std::span<const double> acceleration, double h2) {
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first + 1 < acceleration.size(); first += stretch_size) {
    const std::size_t last = std::min(first + stretch_size, acceleration.size() - 1);
    stretches.push_back(stretch_of(acceleration, h2, first, last));
  }
  return stretches;
}

}  // namespace pounding::oscillator
