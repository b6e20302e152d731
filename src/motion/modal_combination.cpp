#include "motion/modal_combination.h"

#include <algorithm>
#include <cmath>

namespace pounding {

double modal_correlation(double frequency_1, double ratio_1, double frequency_2, double ratio_2) {
  if (frequency_1 == frequency_2 && ratio_1 == ratio_2) return 1;
  if (!(frequency_1 > 0) || !(frequency_2 > 0)) return 0;
  const double r = frequency_2 / frequency_1;
  const double below = std::pow(1 - r * r, 2) + 4 * ratio_1 * ratio_2 * r * (1 + r * r) +
                       4 * (ratio_1 * ratio_1 + ratio_2 * ratio_2) * r * r;
  if (!(below > 0)) return 0;
  return 8 * std::sqrt(ratio_1 * ratio_2) * (ratio_1 + r * ratio_2) * std::pow(r, 1.5) / below;
}

ModalCorrelations::ModalCorrelations(std::span<const double> frequencies,
                                     std::span<const double> ratios)
    : size_(frequencies.size()), rho_(size_ * size_) {
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t j = 0; j < size_; ++j) {
      rho_[i * size_ + j] =
          i == j ? 1 : modal_correlation(frequencies[i], ratios[i], frequencies[j], ratios[j]);
    }
  }
}

double ModalCorrelations::combined(std::span<const double> peaks, std::size_t first,
                                   std::size_t last) const {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) {
    for (std::size_t j = first; j < last; ++j) sum += at(i, j) * peaks[i] * peaks[j];
  }
  return std::sqrt(std::max(0.0, sum));
}

}  // namespace pounding
