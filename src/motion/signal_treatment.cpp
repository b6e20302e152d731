#include "motion/signal_treatment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/error.h"

namespace pounding {
namespace {

constexpr std::array<const char*, 5> names{"complete", "all_peaks", "highest_peak", "without_peaks",
                                           "dirac"};

// Samples whose steps meet [start, end]; steps that only touch an end are no part of it.
SignalPeak samples_within(const SampledSignal& signal, double start, double end) {
  const double h = signal.time_step;
  const auto place = [&](double time) { return (time - signal.first_time) / h + 0.5; };
  const auto size = static_cast<double>(signal.acceleration.size());
  constexpr double round_off = 1e-6;  // of a step
  const double first = std::clamp(std::floor(place(start) + round_off), 0.0, size);
  const double last = std::clamp(std::ceil(place(end) - round_off), first, size);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last), 0};
}

double impulse(const SampledSignal& signal, const SignalPeak& peak) {
  double sum = 0;
  for (std::size_t k = peak.first; k < peak.last; ++k) sum += signal.acceleration[k];
  return sum * signal.time_step;
}

SampledSignal triangle(const SampledSignal& signal, const SignalPeak& peak, double step) {
  if (!(step > 0)) throw UserError("treatment dirac needs a time step above 0");
  const double middle = 0.5 * static_cast<double>(peak.first + peak.last - 1);
  const double time = signal.first_time + middle * signal.time_step;
  return {{0, peak.impulse / step, 0}, step, time - step};
}

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

std::span<const char* const> treatment_names() {
  return names;
}

std::vector<SignalPeak> find_peaks(const SampledSignal& signal, std::span<const TimeWindow> windows,
                                   double margin) {
  std::vector<SignalPeak> found;
  for (const TimeWindow& window : windows) {
    const SignalPeak peak = samples_within(signal, window.start - margin, window.end + margin);
    if (peak.first < peak.last) found.push_back(peak);
  }
  std::ranges::sort(found, {}, &SignalPeak::first);
  std::vector<SignalPeak> peaks;
  for (const SignalPeak& peak : found) {
    if (!peaks.empty() && peak.first <= peaks.back().last) {
      peaks.back().last = std::max(peaks.back().last, peak.last);
    } else {
      peaks.push_back(peak);
    }
  }
  for (SignalPeak& peak : peaks) peak.impulse = impulse(signal, peak);
  return peaks;
}

const SignalPeak& highest_peak(std::span<const SignalPeak> peaks) {
  return *std::ranges::max_element(peaks, {},
                                   [](const SignalPeak& peak) { return std::abs(peak.impulse); });
}

SampledSignal treat(const SampledSignal& signal, std::span<const SignalPeak> peaks,
                    Treatment treatment, double dirac_step) {
  const bool keep_peaks = treatment == Treatment::all_peaks || treatment == Treatment::highest_peak;
  if (treatment == Treatment::complete) return signal;
  if (treatment == Treatment::dirac && !peaks.empty()) {
    return triangle(signal, highest_peak(peaks), dirac_step);
  }
  SampledSignal treated = signal;
  if (treatment != Treatment::without_peaks) std::ranges::fill(treated.acceleration, 0.0);
  for (const SignalPeak& peak : peaks) {
    if (treatment == Treatment::highest_peak && &peak != &highest_peak(peaks)) continue;
    for (std::size_t k = peak.first; k < peak.last; ++k) {
      treated.acceleration[k] = keep_peaks ? signal.acceleration[k] : 0;
    }
  }
  return treated;
}

std::vector<double> low_pass(std::span<const double> samples, double interval, double frequency) {
  std::vector<double> filtered(samples.begin(), samples.end());
  const TwoPoles poles(interval, frequency);
  poles.pass(filtered.begin(), filtered.end());
  poles.pass(filtered.rbegin(), filtered.rend());
  return filtered;
}

}  // namespace pounding
