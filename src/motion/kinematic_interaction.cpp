#include "motion/kinematic_interaction.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "motion/fourier.h"

namespace pounding {
namespace {

constexpr double largest_rotation = 0.26;
/// a0 beyond which the factors are constant.
constexpr double end_of_translation = 1.1;
constexpr double end_of_rotation = std::numbers::pi / 2;

/// Times of travel D / V_s after which nothing is left of the filter.
constexpr double memory = 50;

/// Adds the samples that the filter puts before t = 0, found at the end of the period, to two later
/// ones, so that velocity and displacement end as they would. `half`: the share of the first sample
/// that straight lines between samples lose.
void fold(std::vector<double>& samples, std::size_t tail, double half) {
  double sum = half;
  double moment = 0;
  for (std::size_t k = 1; k <= tail; ++k) {
    const double before = samples[samples.size() - k];
    sum += before;
    moment -= static_cast<double>(k) * before;
  }
  const std::size_t far = std::max<std::size_t>(tail, 2);
  const double there = (moment - sum) / static_cast<double>(far - 1);
  samples[1] += sum - there;
  samples[far] += there;
}

/// The signal by a real factor at each circular frequency, with zeros around it.
template <typename Factor>
Accelerogram filtered(const Accelerogram& signal, double travel, const Factor& factor) {
  const double step = signal.time_step;
  const auto tail = static_cast<std::size_t>(std::ceil(memory * travel / step));
  Accelerogram result;
  if (signal.acceleration.empty()) return result;
  result.time_step = step;
  result.start = signal.start;
  std::vector<double>& samples = result.acceleration;
  const std::size_t kept = signal.acceleration.size() + tail;
  const int n = good_fourier_size(static_cast<int>(kept + tail + 3));
  samples = signal.acceleration;
  samples.resize(static_cast<std::size_t>(n), 0.0);
  std::vector<std::complex<double>> spectrum = fourier(samples);
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    spectrum[k] *= factor(2 * std::numbers::pi * static_cast<double>(k) / (n * step) * travel);
  }
  samples = inverse_fourier(spectrum, n);
  fold(samples, tail, (samples[0] - factor(0) * signal.acceleration.front()) / 2);
  samples.resize(std::max<std::size_t>(kept, 3));
  return result;
}

}  // namespace

Accelerogram embedded_translation(const Accelerogram& surface, const Embedment& embedment) {
  return filtered(surface, embedment.travel(),
                  [](double a0) { return std::cos(std::min(a0, end_of_translation)); });
}

Accelerogram embedded_rotation(const Accelerogram& surface, const Embedment& embedment) {
  const double largest = largest_rotation / embedment.half_width;
  return filtered(surface, embedment.travel(), [largest](double a0) {
    return largest * (1 - std::cos(std::min(a0, end_of_rotation)));
  });
}

}  // namespace pounding
