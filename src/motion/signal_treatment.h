#pragma once

#include <span>
#include <vector>

namespace pounding {

/// A sampled acceleration; sample k is the mean over the step centred on `first_time + k
/// time_step`.
struct SampledSignal {
  std::vector<double> acceleration;  ///< [m/s2]
  double time_step = 0;              ///< [s]
  double first_time = 0;             ///< [s]
};

/// Interval in which bodies touch [s].
struct TimeWindow {
  double start = 0;
  double end = 0;
};

/// An acceleration peak: the samples first ... last - 1 that fall into windows of contact.
struct SignalPeak {
  std::size_t first = 0;
  std::size_t last = 0;
  double impulse = 0;  ///< integral of the acceleration over these samples, with its sign [m/s]
};

/// The peaks of a signal: the samples whose steps meet a window widened by `margin` [s] on both
/// sides. Windows may come in any order and overlap; those that share or touch samples become one
/// peak. Windows outside the signal are left out. In the order of time.
std::vector<SignalPeak> find_peaks(const SampledSignal& signal, std::span<const TimeWindow> windows,
                                   double margin);

/// Treatments of a signal with impacts (Ambiel et al., Eng. Struct. 251, 2022, section 4.2).
enum class Treatment {
  complete,       ///< everything
  all_peaks,      ///< the peaks, zero between them
  highest_peak,   ///< the peak with the largest |impulse|, zero elsewhere
  without_peaks,  ///< everything but the peaks, which are zero
  dirac           ///< a triangle of base twice a short step with the impulse of the highest peak
};

/// "complete", ... , in the order of the enumeration.
std::span<const char* const> treatment_names();

/// The peak with the largest |impulse|, the earliest of several; `peaks` must not be empty.
const SignalPeak& highest_peak(std::span<const SignalPeak> peaks);

/// The treated signal, on the samples of `signal`; for `dirac` it has the three samples 0, J / h, 0
/// at a step h = `dirac_step` [s], around the middle of the highest peak. Without peaks all but
/// `complete` and `without_peaks` are zero. Throws UserError for `dirac` without a step above 0.
SampledSignal treat(const SampledSignal& signal, std::span<const SignalPeak> peaks,
                    Treatment treatment, double dirac_step);

/// Largest frequency of a low-pass of samples, times the interval between them [-].
constexpr double low_pass_limit = 0.25;

/// Samples after a low-pass without phase: two poles of Butterworth, run forwards and then
/// backwards, of which both passes together leave 1/sqrt(2) at `frequency` and the share
///
///     1 / (1 + (sqrt(2) - 1) (tan(pi f h) / tan(pi frequency h))^4)
///
/// of every other f, h = `interval` [s]. It is the filter of SAE J211-1 and ISO 6487 for impacts,
/// whose channel class is frequency / 1.65. Before the first sample the signal has the value there,
/// and after the last one it keeps it. `frequency` [Hz], above 0 and at most low_pass_limit /
/// `interval`.
std::vector<double> low_pass(std::span<const double> samples, double interval, double frequency);

}  // namespace pounding
