#pragma once

#include <vector>

#include "common/petsc.h"
#include "system/linear_system.h"

namespace pounding {

/// A = M^-1/2 (sum of f_i B_i) M^-1/2 + s I as an operator, from products with the B_i alone.
class ScaledOperator {
 public:
  struct Term {
    double factor = 1;                   ///< f_i
    const Stiffness* operand = nullptr;  ///< B_i; must outlive the operator
  };
  /// Collective.
  ScaledOperator(const LinearSystem& system, std::vector<Term> terms, double shift = 0);
  ScaledOperator(const ScaledOperator&) = delete;
  ScaledOperator& operator=(const ScaledOperator&) = delete;

  /// A as PETSc's shell: multiplies, has no entries. Borrowed.
  Mat matrix() const { return shell_.get(); }
  /// y = A x. Collective.
  void apply(Vec x, Vec y) const;
  /// y^T A y of a vector over the owned dofs. Collective.
  double quotient(std::vector<double>& y) const;

 private:
  const LinearSystem& system_;
  std::vector<Term> terms_;
  double shift_;
  std::vector<double> scale_;  ///< of M^-1/2, per owned dof
  VecHandle diagonal_;         ///< scale_
  VecHandle argument_;         ///< M^-1/2 x
  VecHandle product_;          ///< of one term
  MatHandle shell_;
};

}  // namespace pounding
