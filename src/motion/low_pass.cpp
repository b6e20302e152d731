#include "motion/low_pass.h"

#include <cmath>
#include <iterator>
#include <numbers>

namespace pounding {
namespace {

/// y_n = y_{n-1} + a (y_{n-1} - y_{n-2}) + b (x_n + 2 x_{n-1} + x_{n-2} - 4 y_{n-1}): in this order
/// a constant is kept, however short the interval.
struct TwoPoles {
  double b = 0;
  double a = 0;

  /// Two poles of Butterworth by the bilinear transformation: half a pass of both.
  TwoPoles(double interval, double frequency) {
    constexpr double root = std::numbers::sqrt2;
    const double w =
        std::tan(std::numbers::pi * frequency * interval) / std::sqrt(std::sqrt(root - 1));
    const double scale = 1 / (1 + root * w + w * w);
    b = w * w * scale;
    a = (1 - root * w + w * w) * scale;
  }

  /// Filters in place, from a signal that has long been its first value.
  template <class Iterator>
  void pass(Iterator begin, Iterator end) const {
    if (begin == end) return;
    double x1 = *begin, x2 = x1, y1 = x1, y2 = x1;
    for (Iterator at = begin; at != end; ++at) {
      const double x = *at;
      const double y = y1 + (a * (y1 - y2) + b * (x + 2 * x1 + x2 - 4 * y1));
      x2 = x1;
      x1 = x;
      y2 = y1;
      y1 = y;
      *at = y;
    }
  }
};

}  // namespace

std::vector<double> low_pass(std::span<const double> samples, double interval, double frequency) {
  std::vector<double> filtered(samples.begin(), samples.end());
  const TwoPoles poles(interval, frequency);
  poles.pass(filtered.begin(), filtered.end());
  poles.pass(filtered.rbegin(), filtered.rend());
  return filtered;
}

}  // namespace pounding
