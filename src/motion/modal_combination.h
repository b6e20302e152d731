#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pounding {

/// Correlation of the responses of two oscillators to one broad-banded motion (Der Kiureghian,
/// Earthquake Eng. Struct. Dyn. 9 (1981), 419; exact for white noise), frequencies in one unit,
/// r = f2 / f1:
///
///     rho = 8 sqrt(z1 z2) (z1 + r z2) r^1.5
///           / ((1 - r^2)^2 + 4 z1 z2 r (1 + r^2) + 4 (z1^2 + z2^2) r^2)
///
/// 1 for two alike, 0 where one of two others has no frequency or none has damping.
double modal_correlation(double frequency_1, double ratio_1, double frequency_2, double ratio_2);

/// Correlations of all pairs of modes.
class ModalCorrelations {
 public:
  /// Frequency [Hz] and damping ratio of each mode.
  ModalCorrelations(std::span<const double> frequencies, std::span<const double> ratios);

  double at(std::size_t i, std::size_t j) const { return rho_[i * size_ + j]; }
  /// Peak of a sum of modal responses with these peaks, signs kept (CQC):
  /// sqrt(sum_ij rho_ij d_i d_j), over the modes of [first, last).
  double combined(std::span<const double> peaks, std::size_t first, std::size_t last) const;

 private:
  std::size_t size_;
  std::vector<double> rho_;
};

}  // namespace pounding
