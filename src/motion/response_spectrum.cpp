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
  const std::vector<double> peaks =
      acceleration.empty() ? std::vector<double>(oscillators.size(), 0.0)
                           : peak_displacements(acceleration, time_step, oscillators, after);
  std::vector<std::vector<SpectrumPoint>> spectra(damping_ratios.size());
  for (std::size_t i = 0; i < oscillators.size(); ++i) {
    const double frequency = frequencies[i / spectra.size()];
    const double omega = 2 * std::numbers::pi * frequency;
    spectra[i % spectra.size()].push_back(
        {frequency, peaks[i], omega * peaks[i], omega * omega * peaks[i]});
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

}  // namespace pounding
