#pragma once

#include <complex>
#include <span>
#include <vector>

#include "motion/accelerogram.h"

namespace pounding {

/// Smallest size >= n that is a product of 2, 3 and 5, and even.
int good_fourier_size(int n);

/// Spectrum of a real signal: X_k = sum_j x_j exp(-2 pi i j k / n), k = 0 .. n/2. The plans are
/// estimated, not timed, so that the same build gives the same bits.
std::vector<std::complex<double>> fourier(std::span<const double> signal);

/// Real signal of n values from its first coefficients (at most n/2 + 1; the others are zero);
/// divided by n, so that it inverts `fourier`.
std::vector<double> inverse_fourier(std::span<const std::complex<double>> spectrum, int n);

/// Time step to which motions are resampled before they are integrated [s].
inline constexpr double resampled_step = 5e-4;

/// The band-limited signal through the values of an accelerogram, sampled at the largest whole
/// fraction of its time step that is <= `largest_step` [s]: Fourier coefficients padded with zeros.
/// Before the transform each end continues as its own point reflection, fading to zero, so that
/// nothing rings across the ends. The given values are kept; between them the peak may grow.
/// Returns the accelerogram itself when its step is already short enough.
Accelerogram resample_band_limited(const Accelerogram& accelerogram, double largest_step);

}  // namespace pounding
