#pragma once

#include <vector>

#include "common/petsc.h"
#include "modal/eigen_solver.h"
#include "system/linear_system.h"

namespace pounding {

/// How fast a structure can move along a force f per root of its energy: the discrete energy is at
/// least 1/2 v^T A v with
///
///     A = M - dt/2 C - dt^2/4 K
///
/// (dynamics/energy_balance.h), so that |f^T v| <= |f| sqrt(2 E) with |f|^2 = f^T A^-1 f. Every
/// tension-only bar counts as taut. Conjugate gradients give x near A^-1 f; with r = f - A x,
///
///     f^T A^-1 f = x^T f + r^T A^-1 r <= x^T f + r^T M^-1 r / eta
///
/// is a bound however far they came, eta the smallest eigenvalue of M^-1 A.
class EnergyNorm {
 public:
  /// `energy_margin`: a lower bound of eta [-]. `work`: products with K times dofs that all calls
  /// together may cost; beyond it bounds get wider. Collective.
  EnergyNorm(const LinearSystem& system, double time_step, double energy_margin, double work);

  /// Nothing is left of the work: bounds are no closer than |f|_M^-1 / sqrt(eta).
  bool exhausted() const { return iterations_left_ < 1; }
  /// Upper bound of |f|, f over the owned dofs [N s or kg m/s: then kg^1/2 m/s; rows of a contact
  /// operator: kg^-1/2]; need not be closer than `enough`. Infinite if the energy margin is not
  /// above 0. Collective.
  double bound(std::vector<double> f, double enough = 0);

 private:
  const LinearSystem& system_;
  ScaledOperator scaled_;  ///< G^-1 A G^-T with M = G G^T
  VecHandle direction_;    ///< of conjugate gradients
  VecHandle product_;      ///< of A with it
  double energy_margin_;
  double iterations_left_;
};

}  // namespace pounding
