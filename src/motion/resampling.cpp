#include "motion/resampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/fourier.h"

namespace pounding {

namespace {

constexpr std::size_t longest_extension = 512;  // samples on either side

}  // namespace

Accelerogram resample_band_limited(const Accelerogram& accelerogram, double largest_step) {
  const auto& a = accelerogram.acceleration;
  const int factor = static_cast<int>(std::ceil(accelerogram.time_step / largest_step - 1e-9));
  const std::size_t size = a.size();
  if (factor <= 1 || size < 2) return accelerogram;

  const std::size_t extension = std::min(size - 1, longest_extension);
  const int n = good_fourier_size(static_cast<int>(size + 2 * extension));
  std::vector<double> extended(n, 0.0);
  std::copy(a.begin(), a.end(), extended.begin() + static_cast<std::ptrdiff_t>(extension));
  for (std::size_t i = 1; i <= extension; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(extension);
    const double fade = 0.5 * (1 + std::cos(std::numbers::pi * x));
    extended[extension - i] = fade * (2 * a[0] - a[i]);
    extended[extension + size - 1 + i] = fade * (2 * a[size - 1] - a[size - 1 - i]);
  }

  auto spectrum = fourier(extended);
  spectrum.back() *= 0.5;  // the Nyquist term is shared by its positive and negative frequency
  for (auto& coefficient : spectrum) coefficient *= factor;
  const auto fine = inverse_fourier(spectrum, n * factor);
  const std::size_t stride = factor;
  Accelerogram result;
  result.time_step = accelerogram.time_step / factor;
  result.start = accelerogram.start;
  const auto begin = fine.begin() + static_cast<std::ptrdiff_t>(extension * stride);
  result.acceleration.assign(begin, begin + static_cast<std::ptrdiff_t>((size - 1) * stride + 1));
  for (std::size_t i = 0; i < size; ++i) result.acceleration[i * stride] = a[i];
  return result;
}

}  // namespace pounding
