#include "motion/fourier.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fftw3.h>

namespace pounding {
namespace {

struct Free {
  void operator()(void* memory) const { fftw_free(memory); }
};

struct Workspace {
  int size;
  std::unique_ptr<double, Free> signal;
  std::unique_ptr<fftw_complex, Free> spectrum;

  explicit Workspace(int n)
      : size(n),
        signal(fftw_alloc_real(static_cast<std::size_t>(n))),
        spectrum(fftw_alloc_complex(static_cast<std::size_t>(n) / 2 + 1)) {}
};

void execute(fftw_plan plan) {
  fftw_execute(plan);
  fftw_destroy_plan(plan);
}

constexpr std::size_t longest_extension = 512;  // samples on either side

}  // namespace

int good_fourier_size(int n) {
  for (int size = n + n % 2;; size += 2) {
    int rest = size;
    for (const int prime : {2, 3, 5}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return size;
  }
}

std::vector<std::complex<double>> fourier(std::span<const double> signal) {
  const int n = static_cast<int>(signal.size());
  const Workspace work(n);
  const auto plan = fftw_plan_dft_r2c_1d(n, work.signal.get(), work.spectrum.get(), FFTW_ESTIMATE);
  std::copy(signal.begin(), signal.end(), work.signal.get());
  execute(plan);
  std::vector<std::complex<double>> result(n / 2 + 1);
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] = {work.spectrum.get()[k][0], work.spectrum.get()[k][1]};
  }
  return result;
}

std::vector<double> inverse_fourier(std::span<const std::complex<double>> spectrum, int n) {
  const Workspace work(n);
  const auto plan = fftw_plan_dft_c2r_1d(n, work.spectrum.get(), work.signal.get(), FFTW_ESTIMATE);
  for (std::size_t k = 0; k < static_cast<std::size_t>(n) / 2 + 1; ++k) {
    const auto value = k < spectrum.size() ? spectrum[k] : 0.0;
    work.spectrum.get()[k][0] = value.real();
    work.spectrum.get()[k][1] = value.imag();
  }
  execute(plan);
  std::vector<double> result(work.signal.get(), work.signal.get() + n);
  for (double& value : result) value /= n;
  return result;
}

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
