#pragma once

#include <span>
#include <vector>

#include "motion/after_record.h"

namespace pounding {

/// One line of a response spectrum, omega = 2 pi frequency.
struct SpectrumPoint {
  double frequency = 0;            ///< undamped oscillator [Hz]
  double displacement = 0;         ///< SD = max |u| [m]
  double pseudo_velocity = 0;      ///< PSV = omega SD [m/s]
  double pseudo_acceleration = 0;  ///< PSA = omega^2 SD [m/s2]
};

/// True peaks of the same oscillator, which differ from the pseudo ones away from resonance.
struct TrueSpectrumPoint {
  double frequency = 0;              ///< undamped oscillator [Hz]
  double velocity = 0;               ///< SV = max |u'|, relative to the support [m/s]
  double absolute_acceleration = 0;  ///< SA = max |u'' + a| [m/s2]
  double relative_acceleration = 0;  ///< max |u''| [m/s2]
};

/// Response spectrum of an acceleration sampled every `time_step` [s] from t = 0, linear between
/// samples and zero after the last one; the oscillators start at rest. The maxima are exact:
/// extrema inside a step are searched, and the free vibration after the record is maximised in
/// closed form. A frequency of zero gives SD = max |ground displacement| over the record.
/// `acceleration` [m/s2], `frequencies` [Hz] >= 0, `damping_ratio` in [0, 1); one point per
/// frequency, in their order. Throws UserError for arguments out of range or not finite.
std::vector<SpectrumPoint> response_spectrum(std::span<const double> acceleration, double time_step,
                                             std::span<const double> frequencies,
                                             double damping_ratio,
                                             AfterRecord after = AfterRecord::free_vibration);

/// Response spectra of several damping ratios, in their order: as response_spectrum gives them one
/// after the other, at less cost.
std::vector<std::vector<SpectrumPoint>> response_spectra(
    std::span<const double> acceleration, double time_step, std::span<const double> frequencies,
    std::span<const double> damping_ratios, AfterRecord after = AfterRecord::free_vibration);

/// The true peaks of the same motion, as exact as those of response_spectrum. An acceleration that
/// does not begin with zero sets in as a jump at t = 0, and one that does not end with zero ends
/// with one.
std::vector<TrueSpectrumPoint> true_response_spectrum(
    std::span<const double> acceleration, double time_step, std::span<const double> frequencies,
    double damping_ratio, AfterRecord after = AfterRecord::free_vibration);

/// Response spectra of a pair of horizontal accelerations whatever directions their axes
/// have: at each frequency the peak of the oscillator along every direction in the plane, each
/// degree of half a turn, and of these 180 peaks a percentile. RotD50 is their median, RotD100
/// their largest (D. M. Boore, BSSA 100 (2010), 1830). Percentiles between two peaks are linear
/// between them.
///
/// `first`, `second` [m/s2] of one length, `percentiles` in [0, 100]; else as response_spectrum.
/// One spectrum per damping ratio and percentile, the percentiles of a ratio one after the other.
/// Throws UserError.
std::vector<std::vector<SpectrumPoint>> rotated_spectra(
    std::span<const double> first, std::span<const double> second, double time_step,
    std::span<const double> frequencies, std::span<const double> damping_ratios,
    std::span<const double> percentiles, AfterRecord after = AfterRecord::free_vibration);

}  // namespace pounding
