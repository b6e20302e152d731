#pragma once

#include <span>

#include "scene/scene.h"

namespace pounding {

/// The frequency [Hz] of the low-pass before stated peaks of records at this interval [s]: what was
/// asked, or the highest that they can hold.
double stated_frequency(const Scene& scene, double interval);

/// Largest magnitude of an acceleration after that low-pass, from record `first` on.
double stated_peak(std::span<const double> acceleration, double interval, double frequency,
                   std::size_t first);

}  // namespace pounding
