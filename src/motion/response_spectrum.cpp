#include "motion/response_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "common/error.h"
#include "motion/oscillator_peaks.h"

namespace pounding {
namespace {

using namespace oscillator;

void check(bool ok, const char* what, double seen) {
  if (!ok) {
    throw UserError("response spectrum: " + std::string(what) + ", not " + std::to_string(seen));
  }
}

void check_arguments(std::span<const double> acceleration, double time_step,
                     std::span<const double> frequencies, double damping_ratio) {
  check(std::isfinite(time_step) && time_step > 0, "time step must be positive", time_step);
  check(damping_ratio >= 0 && damping_ratio < 1, "damping ratio must be in [0, 1)", damping_ratio);
  for (const double f : frequencies) {
    check(std::isfinite(f) && f >= 0, "frequencies must be finite and not negative", f);
  }
  for (const double a : acceleration) check(std::isfinite(a), "accelerations must be finite", a);
}

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

std::vector<std::vector<SpectrumPoint>> response_spectra(std::span<const double> acceleration,
                                                         double time_step,
                                                         std::span<const double> frequencies,
                                                         std::span<const double> damping_ratios,
                                                         AfterRecord after) {
  std::vector<Oscillator> oscillators;  // those of a frequency move much alike: side by side
  for (const double ratio : damping_ratios) {
    check_arguments(acceleration, time_step, frequencies, ratio);
  }
  for (const double frequency : frequencies) {
    for (const double ratio : damping_ratios) {
      oscillators.push_back(make_oscillator(2 * std::numbers::pi * frequency * time_step, ratio));
    }
  }
  const bool rests = std::ranges::all_of(acceleration, [](double a) { return a == 0; });
  const std::vector<double> peaks =
      rests ? std::vector<double>(oscillators.size(), 0.0)
            : peak_displacements(acceleration, time_step, oscillators, after);
  std::vector<std::vector<SpectrumPoint>> spectra(damping_ratios.size());
  for (std::size_t i = 0; i < oscillators.size(); ++i) {
    spectra[i % spectra.size()].push_back(point_of(frequencies[i / spectra.size()], peaks[i]));
  }
  return spectra;
}

std::vector<SpectrumPoint> response_spectrum(std::span<const double> acceleration, double time_step,
                                             std::span<const double> frequencies,
                                             double damping_ratio, AfterRecord after) {
  return std::move(
      response_spectra(acceleration, time_step, frequencies, {&damping_ratio, 1}, after)[0]);
}

std::vector<TrueSpectrumPoint> true_response_spectrum(std::span<const double> acceleration,
                                                      double time_step,
                                                      std::span<const double> frequencies,
                                                      double damping_ratio, AfterRecord after) {
  check_arguments(acceleration, time_step, frequencies, damping_ratio);
  std::vector<TrueSpectrumPoint> spectrum;
  spectrum.reserve(frequencies.size());
  for (const double frequency : frequencies) {
    const double theta = 2 * std::numbers::pi * frequency * time_step;
    std::array<double, 3> peaks{};
    if (!acceleration.empty()) {
      peaks = true_peaks(acceleration, time_step, make_oscillator(theta, damping_ratio), after);
    }
    spectrum.push_back({frequency, peaks[0] / time_step, peaks[1] / (time_step * time_step),
                        peaks[2] / (time_step * time_step)});
  }
  return spectrum;
}

std::vector<std::vector<SpectrumPoint>> rotated_spectra(
    std::span<const double> first, std::span<const double> second, double time_step,
    std::span<const double> frequencies, std::span<const double> damping_ratios,
    std::span<const double> percentiles, AfterRecord after) {
  refuse_if(first.size() != second.size(), "two components of " + std::to_string(first.size()) +
                                               " and " + std::to_string(second.size()) +
                                               " samples are no pair");
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
