#include "motion/fourier.h"

#include <algorithm>
#include <memory>

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

}  // namespace pounding
