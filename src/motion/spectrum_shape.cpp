#include "motion/spectrum_shape.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"

namespace pounding {

namespace {

// Linear in log-log between two points; linear where a value is zero.
double between(double f1, double value1, double f2, double value2, double f) {
  if (!(value1 > 0 && value2 > 0)) return value1 + (value2 - value1) * (f - f1) / (f2 - f1);
  return value1 * std::pow(value2 / value1, std::log(f / f1) / std::log(f2 / f1));
}

double value_at(std::span<const double> frequencies, std::span<const double> values, double f) {
  if (f <= frequencies.front()) return values.front();
  if (f >= frequencies.back()) return values.back();
  const auto above = std::ranges::upper_bound(frequencies, f);
  const std::size_t i = above - frequencies.begin();
  return between(frequencies[i - 1], values[i - 1], frequencies[i], values[i], f);
}

}  // namespace

std::vector<double> regulatory_frequencies() {
  struct Range {
    int end;   // [0.01 Hz]
    int step;  // [0.01 Hz]
  };
  constexpr Range ranges[] = {{300, 10},  {360, 15},   {500, 20},   {800, 25},
                              {1500, 50}, {1800, 100}, {2200, 200}, {3400, 300}};
  std::vector<double> frequencies;
  int f = 20;
  for (const Range& range : ranges) {
    for (; f < range.end; f += range.step) frequencies.push_back(f / 100.0);
  }
  frequencies.push_back(f / 100.0);
  return frequencies;
}

std::vector<double> envelope_of(std::span<const std::vector<double>> spectra) {
  std::vector<double> envelope = spectra.front();
  for (const auto& spectrum : spectra) {
    std::ranges::transform(envelope, spectrum, envelope.begin(),
                           [](double a, double b) { return std::max(a, b); });
  }
  return envelope;
}

std::vector<double> broadened(std::span<const double> frequencies, std::span<const double> values,
                              double fraction) {
  if (!(fraction >= 0 && fraction < 1)) {
    throw UserError("broadening must be in [0, 1), not " + std::to_string(fraction));
  }
  std::vector<double> result(values.begin(), values.end());
  if (fraction == 0) return result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double low = frequencies[i] / (1 + fraction), high = frequencies[i] / (1 - fraction);
    result[i] = std::max(value_at(frequencies, values, low), value_at(frequencies, values, high));
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (frequencies[k] >= low && frequencies[k] <= high) {
        result[i] = std::max(result[i], values[k]);
      }
    }
  }
  return result;
}

}  // namespace pounding
