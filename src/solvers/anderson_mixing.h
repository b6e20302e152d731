#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pounding::interactions {

/// Anderson's mixing of a fixed-point iteration x <- g(x): from the last steps the combination
/// whose changes f = g(x) - x, with weights, cancel best,
///
///     x_{k+1} = g_k - dG c,   c = argmin | f_k - dF c |
///
/// with dF, dG the differences of f and g over the last `depth` steps (D. G. Anderson, J. ACM 12
/// (1965) 547; Walker and Ni, SIAM J. Numer. Anal. 49 (2011) 1715). The same input gives the same
/// bits. No allocation after construction.
class AndersonMixing {
 public:
  static constexpr std::size_t depth = 10;

  explicit AndersonMixing(std::size_t most_values);

  /// Begins anew: the next step has no history.
  void forget();
  /// The next x, of shape (n), from x and its image g(x); false, with x the image and the history
  /// forgotten, where the last steps say nothing. `weight` of each value's change, >= 0.
  bool mix(std::span<const double> weight, std::span<const double> image, std::span<double> x);

 private:
  /// c of the last `count_` differences into `factor_`; false where they are dependent.
  bool solve();

  std::size_t count_ = 0;  ///< of differences
  std::size_t next_ = 0;   ///< place of the next one
  bool has_last_ = false;
  std::vector<double> last_image_;
  std::vector<double> last_change_;           ///< weighted
  std::vector<double> change_;                ///< of the image, weighted
  std::vector<std::vector<double>> changes_;  ///< dF
  std::vector<std::vector<double>> images_;   ///< dG
  std::vector<double> matrix_;                ///< dF^T dF, scaled; then its Cholesky factor
  std::vector<double> scale_;
  std::vector<double> factor_;
};

}  // namespace pounding::interactions
