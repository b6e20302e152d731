#pragma once

#include <span>
#include <vector>

#include "system/linear_system.h"

namespace pounding::interactions {

/// The dashpots of a structure in generalised coordinates, all of them together. In w = M^1/2 v
/// their matrix is diagonal in its eigenvectors,
///
///     M^-1/2 B^T diag(c) B M^-1/2 = U diag(lambda) U^T,
///
/// so that a step at mid-step, as DashpotLaw has it, is a product each way:
///
///     w+ = w_free - U diag(g) U^T (w_free + w-),     g = h lambda / (1 + h lambda),     h = dt/2
///
/// (half of that h where forces act for half a step). Mats are stiff: hundreds of dashpots under
/// one brake some dozens of motions. Changes below round-off are left out. Local; nothing allocates
/// after construction.
class DashpotModes {
 public:
  /// `rows`: B over the coordinates, shape (dashpots, coordinates); `strengths`: c [N s/m, N m s].
  DashpotModes(const LinearSystem& system, std::span<const double> rows,
               std::span<const double> strengths, double time_step);

  /// `velocity`: v_free of all coordinates, becomes v+; `before`: v-; `share`: of a step, for which
  /// forces act.
  void brake(double share, std::span<const double> before, std::span<double> velocity);
  /// Energy that dashpots lost in that step [J]; `after`: v+ with contact.
  double loss(std::span<const double> before, std::span<const double> after) const;
  /// v- + v+ of that step, before contact.
  std::span<const double> sums() const { return sums_; }
  std::size_t size() const { return lambda_.size(); }

 private:
  const std::vector<double>& mass_;
  const std::vector<double>& inverse_mass_;
  double time_step_;
  std::vector<double> lambda_;  ///< [1/s]
  std::vector<double> rows_;    ///< U^T M^1/2, shape (motions, coordinates)
  std::vector<double> parts_;   ///< per motion
  std::vector<double> pull_;    ///< - M (v+ - v_free), per coordinate [kg m/s]
  std::vector<double> sums_;    ///< per coordinate
  double share_ = 1;
};

}  // namespace pounding::interactions
