#pragma once

#include <span>
#include <vector>

/// Numbers of series.
namespace pounding {

/// Value at `x` of a curve through points `at`, which increase, straight between them and even
/// beyond. One point or more.
double interpolated(std::span<const double> at, std::span<const double> values, double x);

/// Value at `x` > 0 of such a curve that is straight in log-log, and linear between two points one
/// of which is not above zero. `at` > 0.
double log_interpolated(std::span<const double> at, std::span<const double> values, double x);

/// The number in the middle of them in order, of an even count the upper one. One number or more.
double median(std::vector<double> values);

}  // namespace pounding
