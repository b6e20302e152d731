#pragma once

#include "statics/static_stiffness.h"
#include "system/linear_system.h"

namespace pounding {

/// Static stiffness of a structure in generalised coordinates, all on one rank: diagonal, but for
/// the one-way links that its K counts as acting and that are taken out here.
class ReducedStatics final : public StaticStiffness {
 public:
  /// Throws UserError if the stiffness without bars is not positive with the shift.
  ReducedStatics(const LinearSystem& system, double shift);
  void apply(const std::vector<double>& u, std::vector<double>& q) const override;
  void solve(std::vector<double>& x) const override;
  std::string method() const override { return "in generalised coordinates"; }

 private:
  std::vector<double> stiffness_;  ///< shape (n, n)
  std::vector<double> inverse_;    ///< of stiffness + shift M, shape (n, n)
};

}  // namespace pounding
