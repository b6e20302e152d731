#pragma once

#include "dynamics/update.h"

/// Correction of a dof that has made its free step (update.h) and that contact then moves.
namespace pounding {

/// f - q of a dof after the step, from its K u_n and what `memory(i)` says filter i holds [N, N m].
template <typename Memory>
double filtered_part(const Filters<double>& filters, double stiffness_displacement,
                     const Memory& memory) {
  double part = (filters.at_once - 1) * stiffness_displacement;
  for (std::size_t i = 0; i < filters.count; ++i) {
    subtract_product(filters.filters[i].weight, memory(i), part);
  }
  return part;
}

/// Brings a dof, which has settled with v_free, to v+ = `velocity` after contact, and corrects its
/// sums; `before`: its state before the step, `filtered`: see filtered_part. Returns what M s
/// gains.
inline double correct_dof(const StepTerms<double>& terms, double mass,
                          const DofState<double>& before, double velocity, double filtered,
                          DofState<double>& dof, DofSums<double>& sums) {
  const double change = velocity - dof.velocity;
  const double rate =
      terms.inverse > 0
          ? (dof.stiffness_displacement - before.stiffness_displacement) / terms.time_step
          : 0;  // K v-
  sums.stiffness_across += change * rate;
  sums.mass_sum += mass * change * (2 * (dof.velocity + before.velocity) + change);
  sums.filtered += filtered * change;
  dof.velocity = velocity;
  dof.displacement = before.displacement;
  add_product(terms.time_step, velocity, dof.displacement);
  return mass * change;
}

}  // namespace pounding
