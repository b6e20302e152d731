#pragma once

#include "dynamics/update.h"

/// Correction of a dof that has made its free step (update.h) and that contact then moves.
namespace pounding {

/// Forces of a step at a dof [N, N m].
struct DofForces {
  double stiffness = 0;  ///< q
  double acting = 0;     ///< f without inelastic elements, which is q where nothing filters it
};

/// Brings a dof, which has settled with v_free, to v+ = `velocity` after contact, and corrects its
/// sums; `before`: its state before the step. Returns the gain of M s.
inline double correct_dof(const StepTerms<double>& terms, double mass,
                          const DofState<double>& before, double velocity, const DofForces& forces,
                          DofState<double>& dof, DofSums<double>& sums) {
  const double change = velocity - dof.velocity;
  sums.stiffness_work += forces.stiffness * change;
  sums.mass_sum += mass * change * (2 * (dof.velocity + before.velocity) + change);
  sums.filtered += (forces.acting - forces.stiffness) * change;
  dof.velocity = velocity;
  dof.displacement = before.displacement;
  add_product(terms.time_step, velocity, dof.displacement);
  return mass * change;
}

}  // namespace pounding
