#pragma once

#include <complex>
#include <limits>
#include <vector>

#include "common/dense_matrix.h"

namespace pounding {

/// Rates of a dashpot in series with a spring and a mass, over a unit: spring over dashpot, and
/// dashpot over mass.
struct SeriesRates {
  double spring = std::numeric_limits<double>::infinity();  ///< infinite: there is no spring
  double mass = 0;                                          ///< 0: there is no mass

  /// i omega / (1 + i omega / spring + mass / (i omega)), 0 at omega = 0.
  std::complex<double> at(double omega) const;
};

/// Weighted samples of functions of the frequency as columns: real parts, then imaginary ones.
struct Samples {
  std::vector<double> omega;   ///< increasing, from 0 on, over a unit
  std::vector<double> weight;  ///< of each

  std::vector<double> column(const std::vector<std::complex<double>>& values) const;
  std::vector<std::complex<double>> of(const SeriesRates& rates) const;
  /// Columns of a spring, a dashpot and a mass: 1, i omega, -omega^2.
  DenseMatrix of_grounded() const;
};

/// Rates with which sums of 1, i omega, -omega^2 and `SeriesRates`, each with a factor that is not
/// negative, miss some functions least. `wanted`: columns of the functions.
std::vector<SeriesRates> search_rates(const Samples& samples, const DenseMatrix& wanted);

}  // namespace pounding
