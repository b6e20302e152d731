#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/lanes.h"
#include "interactions/interaction.h"

/// One step of central differences for one dof (double), for several, a lane for each (WideLanes),
/// or for one dof of eight runs (BatchValue): the only place where it is written. With
/// w = u_n + beta v-, v- = v_{n-1/2} and v+ = v_{n+1/2}:
///
///     q       = K w,  given
///     v_free  = v- - h alpha v- - h (a_g - g) iota - h M^-1 ( q + p )
///     u_{n+1} = u_n + dt v+
///
/// with p the force of elements that yield, f in place of q + p where uniform damping filters them
/// (damping_filters.h), v+ = v_free where nothing else acts, and h = dt, but dt / 2 in the first
/// step. Single values are rounded like those of a vector.
namespace pounding {

/// Numbers of a step that all dofs of a structure share.
template <typename Value>
struct StepTerms {
  Value time_step;  ///< dt [s]
  Value duration;   ///< h: how long forces act on the velocity [s]
  Value decay;      ///< 1 - h alpha
  Value beta;       ///< [s]
  Value drag;       ///< h alpha
};

/// Copies the terms into every lane of `Value`.
template <typename Value, typename Number>
StepTerms<Value> in_lanes(const StepTerms<Number>& terms) {
  const Value zero{};
  return {zero + terms.time_step, zero + terms.duration, zero + terms.decay, zero + terms.beta,
          zero + terms.drag};
}

/// State of dofs between two steps; see StateOf.
template <typename Value>
struct DofState {
  Value displacement;
  Value velocity;
};

/// Sums that a step leaves for the energy balance, lane by lane; see StepSums. s = v+ + v-.
template <typename Value>
struct DofSums {
  Value stiffness_work{};  ///< of q s
  Value mass_sum{};
  Value filtered{};    ///< of (f - q - p) s
  Value device{};      ///< of x s, x the force of the extra damping
  Value known_work{};  ///< of M s times the step that supports and loads add to v_free
};

/// Energies before the step, where they are asked for.
template <typename Value>
struct DofEnergies {
  Value kinetic_before{};
  Value stiffness_before{};
  Value strain_before{};
  Value strain_back{};
  Value displacement_mass{};
};

/// v_free [m/s, rad/s]; `ground_step`: h (a_g - g) iota.
template <typename Value>
[[gnu::always_inline]] inline Value free_velocity(const StepTerms<Value>& terms, Value velocity,
                                                  Value force, Value inverse_mass,
                                                  Value ground_step) {
  Value after = -ground_step;
  add_product(terms.decay, velocity, after);
  subtract_product(terms.duration, inverse_mass * force, after);
  return after;
}

/// Adds the energies before the step: v-^T M v-, v-^T K v-, u_n^T K u_{n-1}, u_{n-1}^T K u_n,
/// u_n^T M u_n. With `rate` = K v-, K u_n = q - beta K v- and u_{n-1} = u_n - dt v-.
template <typename Value>
[[gnu::always_inline]] inline void add_energies(const StepTerms<Value>& terms, Value mass,
                                                Value force, Value rate, const DofState<Value>& dof,
                                                DofEnergies<Value>& energies) {
  const Value now = force - terms.beta * rate;
  const Value before = now - terms.time_step * rate;
  const Value displacement_before = dof.displacement - terms.time_step * dof.velocity;
  energies.kinetic_before += mass * dof.velocity * dof.velocity;
  energies.stiffness_before += dof.velocity * rate;
  energies.strain_before += dof.displacement * before;
  energies.strain_back += displacement_before * now;
  energies.displacement_mass += mass * dof.displacement * dof.displacement;
}

/// Brings the dof to the end of the step with v+ = `after`, adds to the sums, and returns
/// M (v+ + v-) [kg m/s, kg m2/s].
template <typename Value>
[[gnu::always_inline]] inline Value settle(const StepTerms<Value>& terms, Value force, Value after,
                                           Value mass, DofState<Value>& dof, DofSums<Value>& sums) {
  const Value sum = after + dof.velocity;
  add_product(terms.time_step, after, dof.displacement);
  dof.velocity = after;
  add_product(force, sum, sums.stiffness_work);
  const Value momentum = mass * sum;
  add_product(momentum, sum, sums.mass_sum);
  return momentum;
}

/// Forces of a step at a dof [N, N m].
template <typename Number>
struct DofForces {
  Number stiffness{};  ///< q
  Number acting{};     ///< f without inelastic elements, which is q where nothing filters it
};

/// Brings a dof, which has settled with v_free, to v+ = `velocity` after contact, and corrects its
/// sums; `before`: its state before the step. Returns the gain of M s.
inline double correct_dof(const StepTerms<double>& terms, double mass,
                          const DofState<double>& before, double velocity,
                          const DofForces<double>& forces, DofState<double>& dof,
                          DofSums<double>& sums) {
  const double change = velocity - dof.velocity;
  sums.stiffness_work += forces.stiffness * change;
  sums.mass_sum += mass * change * (2 * (dof.velocity + before.velocity) + change);
  sums.filtered += (forces.acting - forces.stiffness) * change;
  dof.velocity = velocity;
  dof.displacement = before.displacement;
  add_product(terms.time_step, velocity, dof.displacement);
  return mass * change;
}

/// Dofs that wait until the velocities of all of them are found together; arrays over all dofs.
template <typename Number>
struct WaitingDofs {
  std::vector<Number> stiffness;  ///< q
  std::vector<Number> acting;     ///< f
  std::vector<Number> velocity;   ///< v_free, or the impulse on a mass that is coupled; then v+
};

/// Sums over the owned dofs of a structure that one step leaves for the energy balance, with
/// v- = v_{n-1/2}, v+ = v_{n+1/2}, s = v+ + v-, and those of interactions. The support input
/// is that of the loads on the dofs as well.
struct StepSums : interactions::LedgerPart {
  double stiffness_work = 0;               ///< q^T s [W]
  double mass_sum = 0;                     ///< s^T M s [J]
  std::array<double, 3> momentum{};        ///< iota_d^T M s [kg m/s]
  std::array<double, 3> water_momentum{};  ///< w_d^T s, w_d the ground's load on water [kg m/s]
  double filtered = 0;              ///< (f - q)^T s, f the force that uniform damping filters [W]
  double device = 0;                ///< x^T s, x the force of the extra damping [W]
  double load = 0;                  ///< sum_l f_l p_l^T s of loads [W], in the support input too
  double kinetic_before = 0;        ///< v-^T M v- [J], if energies are asked for
  double added_kinetic_before = 0;  ///< v-^T S v- [J] likewise
  double stiffness_before = 0;      ///< v-^T K v- [W] likewise
  double strain_before = 0;         ///< u_n^T K u_{n-1} [J] likewise
  double strain_back = 0;           ///< u_{n-1}^T K u_n [J] likewise: the same as K is symmetric
  double displacement_mass = 0;     ///< u_n^T M u_n [kg m2] likewise
  double extra_damping_before = 0;  ///< v-^T D v- [W], D the damping beside alpha M + beta K
  double rest_before = 0;           ///< (K u_0)^T (u_0 / 2 - u_n + dt/2 v-) where uniform damping
                                    ///< acts about a rest u_0 [J], if energies are asked for
};

/// All that the dofs of a structure leave in a step, lane by lane.
template <typename Value>
struct StepTotals {
  DofSums<Value> dofs;
  DofEnergies<Value> energies;
  std::array<Value, 3> momentum{};  ///< iota_d^T M s
};

/// Adds them to the sums of their structure; `number`: that of a value.
template <typename Value, typename Number>
void add_to(const StepTotals<Value>& from, const Number& number, StepSums& sums) {
  sums.stiffness_work += number(from.dofs.stiffness_work);
  sums.mass_sum += number(from.dofs.mass_sum);
  sums.filtered += number(from.dofs.filtered);
  sums.device += number(from.dofs.device);
  sums.support_input -= number(from.dofs.known_work) / 2;
  sums.kinetic_before += number(from.energies.kinetic_before);
  sums.stiffness_before += number(from.energies.stiffness_before);
  sums.strain_before += number(from.energies.strain_before);
  sums.strain_back += number(from.energies.strain_back);
  sums.displacement_mass += number(from.energies.displacement_mass);
  for (std::size_t d = 0; d < 3; ++d) sums.momentum[d] += number(from.momentum[d]);
}

}  // namespace pounding
