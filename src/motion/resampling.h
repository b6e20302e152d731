#pragma once

#include "motion/accelerogram.h"

namespace pounding {

/// Time step to which motions are resampled before they are integrated [s].
inline constexpr double resampled_step = 5e-4;

/// The band-limited signal through the values of an accelerogram, sampled at the largest whole
/// fraction of its time step that is <= `largest_step` [s]: Fourier coefficients padded with zeros.
/// Before the transform each end continues as its own point reflection, fading to zero, so that
/// nothing rings across the ends. The given values are kept; between them the peak may grow.
/// Returns the accelerogram itself when its step is already short enough.
Accelerogram resample_band_limited(const Accelerogram& accelerogram, double largest_step);

}  // namespace pounding
