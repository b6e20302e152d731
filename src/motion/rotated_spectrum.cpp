#include "motion/rotated_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.h"

namespace pounding {
namespace {

constexpr int directions = 180;

/// Percentile of values in increasing order, the first being 0 and the last 100.
double percentile_of(const std::vector<double>& sorted, double percent) {
  const double place = percent / 100 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

SpectrumPoint point_of(double frequency, double displacement) {
  const double omega = 2 * std::numbers::pi * frequency;
  return {frequency, displacement, omega * displacement, omega * omega * displacement};
}

}  // namespace

std::vector<std::vector<SpectrumPoint>> rotated_spectra(
    std::span<const double> first, std::span<const double> second, double time_step,
    std::span<const double> frequencies, std::span<const double> damping_ratios,
    std::span<const double> percentiles, AfterRecord after) {
  if (first.size() != second.size()) {
    throw UserError("two components of " + std::to_string(first.size()) + " and " +
                    std::to_string(second.size()) + " samples are no pair");
  }
  // Peaks by ratio, frequency and direction.
  const std::size_t count = frequencies.size();
  std::vector<std::vector<double>> peaks(damping_ratios.size() * count);
  std::vector<double> turned(first.size());
  for (int degree = 0; degree < directions; ++degree) {
    const double angle = degree * std::numbers::pi / directions;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (std::size_t i = 0; i < turned.size(); ++i) turned[i] = c * first[i] + s * second[i];
    const auto spectra = response_spectra(turned, time_step, frequencies, damping_ratios, after);
    for (std::size_t r = 0; r < spectra.size(); ++r) {
      for (std::size_t f = 0; f < count; ++f) {
        peaks[r * count + f].push_back(spectra[r][f].displacement);
      }
    }
  }
  for (std::vector<double>& of_all : peaks) std::ranges::sort(of_all);
  std::vector<std::vector<SpectrumPoint>> result;
  for (std::size_t r = 0; r < damping_ratios.size(); ++r) {
    for (const double percent : percentiles) {
      std::vector<SpectrumPoint>& spectrum = result.emplace_back();
      for (std::size_t f = 0; f < count; ++f) {
        spectrum.push_back(point_of(frequencies[f], percentile_of(peaks[r * count + f], percent)));
      }
    }
  }
  return result;
}

}  // namespace pounding
