#pragma once

#include <span>
#include <vector>

/// Numbers of series.
namespace pounding {

/// Value at `x` of a curve through points `at`, which increase, straight between them and even
/// beyond. One point or more.
double interpolated(std::span<const double> at, std::span<const double> values, double x);

/// The number in the middle of them in order, of an even count the upper one. One number or more.
double median(std::vector<double> values);

}  // namespace pounding
