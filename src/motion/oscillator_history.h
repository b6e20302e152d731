#pragma once

#include <span>
#include <vector>

namespace pounding {

/// Absolute acceleration [m/s2] of an oscillator on a moving base at the samples of the base's
/// acceleration [m/s2], from rest: exact for a base whose acceleration is linear between samples
/// `time_step` [s] apart. `frequency` > 0 [Hz], `damping_ratio` in [0, 1).
std::vector<double> oscillator_history(std::span<const double> acceleration, double time_step,
                                       double frequency, double damping_ratio);

}  // namespace pounding
