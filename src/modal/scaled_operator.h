#pragma once

#include <vector>

#include "common/petsc.h"
#include "system/linear_system.h"

namespace pounding {

/// A = G^-1 (sum of f_i B_i) G^-T + s I as an operator, from products with the B_i alone; G G^T is
/// the mass: G = M^1/2 where it is diagonal.
class ScaledOperator {
 public:
  struct Term {
    double factor = 1;                              ///< f_i
    const stiffness::Stiffness* operand = nullptr;  ///< B_i; must outlive the operator
  };
  /// Collective.
  ScaledOperator(const LinearSystem& system, std::vector<Term> terms, double shift = 0);

  /// y = A x. Collective.
  void apply(Vec x, Vec y) const;
  /// G^-T y of a vector over the owned dofs: the motion of y.
  void to_motion(std::vector<double>& y) const;
  /// G^-1 f of a force over the owned dofs.
  void from_force(std::vector<double>& f) const;

 private:
  enum class Half { plain, transposed };
  /// Applies G^-1 or G^-T where the mass is coupled.
  void solve_coupled(Vec x, Half half) const;
  /// G^-1 or G^-T times a vector over the owned dofs.
  void solve(std::vector<double>& x, Half half) const;

  const LinearSystem& system_;
  std::vector<Term> terms_;
  double shift_;
  std::vector<double> scale_;          ///< of M^-1/2, per owned dof; 1 where the mass is coupled
  mutable std::vector<double> field_;  ///< see CoupledMass
  VecHandle diagonal_;                 ///< scale_
  VecHandle argument_;                 ///< G^-T x
  VecHandle product_;                  ///< of one term
};

}  // namespace pounding
