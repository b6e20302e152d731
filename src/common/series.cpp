#include "common/series.h"

#include <algorithm>
#include <cmath>

namespace pounding {

double interpolated(std::span<const double> at, std::span<const double> values, double x) {
  const auto after = std::ranges::upper_bound(at, x);
  if (after == at.begin()) return values.front();
  if (after == at.end()) return values.back();
  const auto i = static_cast<std::size_t>(after - at.begin());
  const double share = (x - at[i - 1]) / (at[i] - at[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

double log_interpolated(std::span<const double> at, std::span<const double> values, double x) {
  if (x <= at.front()) return values.front();
  if (x >= at.back()) return values.back();
  const auto i = static_cast<std::size_t>(std::ranges::upper_bound(at, x) - at.begin());
  const double low = values[i - 1];
  if (!(low > 0 && values[i] > 0)) {
    return low + (values[i] - low) * (x - at[i - 1]) / (at[i] - at[i - 1]);
  }
  return low * std::pow(values[i] / low, std::log(x / at[i - 1]) / std::log(at[i] / at[i - 1]));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace pounding
