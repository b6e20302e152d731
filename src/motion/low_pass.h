#pragma once

#include <span>
#include <vector>

namespace pounding {

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
