#pragma once

#include <array>
#include <span>
#include <vector>

namespace pounding {

/// Exact step of u'' + 2 xi omega u' + omega^2 u = -a(t) for an acceleration linear over the step
/// h, in the variables (u, h u') and h^2 a, so that everything depends on theta = omega h and xi:
///
///     | u    |            | u    |         | h^2 a_n     |
///     | h u' |      = A   | h u' |   + B   | h^2 a_{n+1} |
///             n+1                  n
struct OscillatorStep {
  std::array<std::array<double, 2>, 2> state{};  ///< A
  std::array<std::array<double, 2>, 2> load{};   ///< B
};

/// Coefficients of the exact step (Nigam and Jennings, BSSA 59, 1969) for theta >= 0 and
/// 0 <= xi < 1. Below theta = 1 they are summed as power series of the step, because the closed
/// form divides differences of nearly equal numbers by theta^3; above it is used.
OscillatorStep oscillator_step(double theta, double damping_ratio);

/// Absolute acceleration [m/s2] of an oscillator on a moving base at the samples of the base's
/// acceleration [m/s2], from rest: exact for a base whose acceleration is linear between samples
/// `time_step` [s] apart. `frequency` > 0 [Hz], `damping_ratio` in [0, 1).
std::vector<double> oscillator_history(std::span<const double> acceleration, double time_step,
                                       double frequency, double damping_ratio);

}  // namespace pounding
