#include "motion/response_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "common/error.h"
#include "motion/oscillator_motion.h"
#include "motion/oscillator_step.h"
#include "motion/peak_displacements.h"

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

// Values of u', u'' or u'' + a at an end of a step: value, first and second derivative
// with respect to s.
struct EndOfStep {
  double value, slope, curvature;
};

// Largest magnitude of one quantity, step by step. `make_step` gives its motion within the step,
// which is needed only where an extremum may lie there.
template <class MakeStep>
void raise_peak(double& peak, const EndOfStep& a, const EndOfStep& b, bool use_series,
                const MakeStep& make_step) {
  peak = std::max(peak, std::abs(b.value));
  if (use_series) {
    const bool turns = a.slope * b.slope <= 0;
    const bool turns_twice = a.slope * a.curvature < 0 && b.slope * b.curvature > 0;
    if (!turns && !turns_twice) return;
    const double bound = std::max(std::abs(a.value), std::abs(b.value)) + std::abs(a.slope) +
                         std::abs(b.slope) + std::abs(a.curvature) + std::abs(b.curvature);
    if (bound <= peak) return;
  }
  peak = std::max(peak, make_step());
}

// Peaks of u', of u'' + a and of u'', in the variables h u', h^2 (u'' + a), h^2 u''.
class TruePeaks {
 public:
  /// `first`: |h^2 a| at rest, where u'' begins with -a.
  TruePeaks(const Oscillator& o, double first) : o_(o), peaks_{0, 0, first} {}

  void add_step(const std::array<double, 4>& start, const std::array<double, 4>& end) {
    const bool use_series = o_.theta < series_limit;
    const auto from = ends(start, end[3] - start[3]), to = ends(end, end[3] - start[3]);
    for (std::size_t i = 0; i < 3; ++i) {
      raise_peak(peaks_[i], from[i], to[i], use_series, [&] {
        if (use_series) {
          return interior_peak(quantity(i, StepSeries(o_, start[0], start[1], start[3], end[3])));
        }
        const StepClosedForm step(o_, start[0], start[1], start[3], end[3]);
        const StepClosedForm wanted = quantity(i, step);
        return wanted.bound(0) > peaks_[i] ? interior_peak(wanted, peaks_[i]) : peaks_[i];
      });
    }
  }

  void add_free_vibration(double u, double v) {
    const auto last = ends({u, v, -(damping() * v + stiffness() * u), 0}, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      peaks_[i] = std::max(peaks_[i], free_vibration_peak(o_, last[i].value, last[i].slope));
    }
  }

  const std::array<double, 3>& peaks() const { return peaks_; }

 private:
  double damping() const { return 2 * o_.xi * o_.theta; }
  double stiffness() const { return o_.theta * o_.theta; }

  // (u, h u', h^2 u'', h^2 a) at an end of a step over which h^2 a changes by `change`.
  std::array<EndOfStep, 3> ends(const std::array<double, 4>& state, double change) const {
    const auto [u, v, w, a] = state;
    const double d = damping(), k = stiffness();
    const double third = -(d * w + k * v + change);
    const double fourth = -(d * third + k * w);
    return {{{v, w, third}, {d * v + k * u, d * w + k * v, d * third + k * w}, {w, third, fourth}}};
  }

  template <class Step>
  Step quantity(std::size_t i, const Step& displacement) const {
    const Step velocity = derivative_of(displacement);
    if (i == 0) return velocity;
    return i == 1 ? sum(stiffness(), displacement, damping(), velocity) : derivative_of(velocity);
  }

  Oscillator o_;
  std::array<double, 3> peaks_;
};

std::array<double, 3> true_peaks(std::span<const double> acceleration, double time_step,
                                 const Oscillator& o, AfterRecord after) {
  const double h2 = time_step * time_step;
  const auto [A, B] = oscillator_step(o.theta, o.xi);
  TruePeaks peaks(o, std::abs(h2 * acceleration[0]));
  std::array<double, 4> state{0, 0, -h2 * acceleration[0], h2 * acceleration[0]};
  for (std::size_t n = 1; n < acceleration.size(); ++n) {
    const auto [u, v, w, a] = state;
    const double a1 = h2 * acceleration[n];
    const double u1 = A[0][0] * u + (A[0][1] * v + (B[0][0] * a + B[0][1] * a1));
    const double v1 = A[1][0] * u + (A[1][1] * v + (B[1][0] * a + B[1][1] * a1));
    const double w1 = -(a1 + 2 * o.xi * o.theta * v1 + o.theta * o.theta * u1);
    const std::array<double, 4> next{u1, v1, w1, a1};
    peaks.add_step(state, next);
    // Rest after a long silence: subnormal numbers would only cost time.
    const bool silent = std::abs(u1) + std::abs(v1) + std::abs(w1) < 1e-250;
    state = silent ? std::array<double, 4>{0, 0, -a1, a1} : next;
  }
  if (after == AfterRecord::free_vibration) peaks.add_free_vibration(state[0], state[1]);
  return peaks.peaks();
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
