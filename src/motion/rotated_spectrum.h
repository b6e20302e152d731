#pragma once

#include <span>
#include <vector>

#include "motion/response_spectrum.h"

namespace pounding {

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
