#pragma once

#include <array>
#include <cstddef>

#include "common/lanes.h"
#include "interactions/interaction.h"

/// One step of central differences for one dof (double) or for several, a lane for each (HalfLanes,
/// Lanes): the only place where it is written. With w = u_n + beta v-, v- = v_{n-1/2} and
/// v+ = v_{n+1/2}:
///
///     q       = K w,  given
///     v_free  = v- - h alpha v- - h (a_g - g) iota - h M^-1 q
///     u_{n+1} = u_n + dt v+
///
/// with f in place of q in v_free where uniform damping filters it (Filters), v+ = v_free where
/// nothing else acts, and h = dt, but dt / 2 in the first step. Single values are rounded like
/// those of a vector.
namespace pounding {

/// Numbers of a step that all dofs of a structure share.
template <typename Value>
struct StepTerms {
  Value time_step;  ///< dt [s]
  Value duration;   ///< h: how long forces act on the velocity [s]
  Value decay;      ///< 1 - h alpha
  Value beta;       ///< [s]
};

/// Copies the terms into every lane of `Value`.
template <typename Value>
StepTerms<Value> in_lanes(const StepTerms<double>& terms) {
  const Value zero{};
  return {zero + terms.time_step, zero + terms.duration, zero + terms.decay, zero + terms.beta};
}

/// State of dofs between two steps; see StructureState.
template <typename Value>
struct DofState {
  Value displacement;
  Value velocity;
};

/// Sums that a step leaves for the energy balance, lane by lane; see StepSums.
template <typename Value>
struct DofSums {
  Value stiffness_work{};  ///< of q (v+ + v-)
  Value mass_sum{};
  Value filtered{};  ///< of (f - q) (v+ + v-)
};

/// Most filters of uniform damping, and one more that holds the forces of a rest.
constexpr std::size_t max_filters = 9;

/// Numbers of the filters of uniform damping that all dofs of a structure share. With Q_n = K u_n,
/// beta = 0, c_i = omega_i dt / 2 and W_i the part that filter i passes,
///
///     W_i^n = k_i W_i^{n-1} + t_i (Q_n + Q_{n-1}),      k_i = (1 - c_i) / (1 + c_i)
///     f     = s ( Q_n + sum_i a_i (Q_n - W_i^n) ),      t_i = c_i / (1 + c_i)
///
/// the trapezoidal rule for dW/dt = omega_i (Q - W). A filter keeps between steps its memory
/// Z_i^n = W_i^n - t_i Q_n, known before Q_n is:
///
///     f         = s (1 + sum_i a_i (1 - t_i)) Q_n - sum_i s a_i Z_i^n
///     Z_i^{n+1} = k_i Z_i^n + t_i (1 + k_i) Q_n
///
/// A run that starts from a rest u_0 has one filter more, with k = 1, t = 0 and s a = -1, whose
/// memory (1 - s) K u_0 stays: the others then act on the change of K u since the rest, where
/// W_i = K u_0.
/// Stable if and only if M - dt^2/4 s (1 + sum a_i) K is positive definite;
/// docs/reference/theory/damping.md has the energy that proves it.
template <typename Value>
struct Filters {
  std::size_t count = 0;
  Value passing;  ///< s (1 + sum a_i (1 - t_i))
  struct Filter {
    Value weight;                                    ///< s a_i
    Value keep;                                      ///< k_i
    Value take;                                      ///< t_i (1 + k_i)
    Value newest() const { return (1 - keep) / 2; }  ///< t_i
  };
  std::array<Filter, max_filters> filters;
};

/// Copies the numbers into every lane of `Value`.
template <typename Value>
Filters<Value> in_lanes(const Filters<double>& filters) {
  const Value zero{};
  Filters<Value> copy{filters.count, zero + filters.passing, {}};
  for (std::size_t i = 0; i < filters.count; ++i) {
    const auto& [weight, keep, take] = filters.filters[i];
    copy.filters[i] = {zero + weight, zero + keep, zero + take};
  }
  return copy;
}

/// Takes the part of one filter off the force f, and brings its memory from n to n + 1.
template <typename Value>
[[gnu::always_inline]] inline void pass_filter(const typename Filters<Value>::Filter& filter,
                                               Value stiffness_force, Value& memory, Value& force) {
  subtract_product(filter.weight, memory, force);
  Value next{};
  add_product(filter.keep, memory, next);
  add_product(filter.take, stiffness_force, next);
  memory = next;
}

/// f of one dof from q and the memories before the step: `memory(i)` that of filter i [N, N m].
template <typename Memory>
double filtered_force(const Filters<double>& filters, double stiffness_force,
                      const Memory& memory) {
  double force = filters.passing * stiffness_force;
  for (std::size_t i = 0; i < filters.count; ++i) {
    subtract_product(filters.filters[i].weight, memory(i), force);
  }
  return force;
}

/// Energies before the step likewise, where they are asked for.
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

/// Correction of a dof that has made its free step and that contact then moves.

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

/// Sums over the owned dofs of a structure that one step leaves for the energy balance, with
/// v- = v_{n-1/2}, v+ = v_{n+1/2}, s = v+ + v-, and those of interactions. The support input
/// is that of the loads on the dofs as well.
struct StepSums : interactions::LedgerPart {
  double stiffness_work = 0;         ///< q^T s [W]
  double mass_sum = 0;               ///< s^T M s [J]
  std::array<double, 3> momentum{};  ///< iota_d^T M s [kg m/s]
  double filtered = 0;               ///< (f - q)^T s, f the force that uniform damping filters [W]
  double device = 0;                 ///< x^T s, x the force of the extra damping [W]
  double load = 0;                   ///< sum_l f_l p_l^T s of loads [W], in the support input too
  double kinetic_before = 0;         ///< v-^T M v- [J], if energies are asked for
  double added_kinetic_before = 0;   ///< v-^T S v- [J] likewise
  double stiffness_before = 0;       ///< v-^T K v- [W] likewise
  double strain_before = 0;          ///< u_n^T K u_{n-1} [J] likewise
  double strain_back = 0;            ///< u_{n-1}^T K u_n [J] likewise: the same as K is symmetric
  double displacement_mass = 0;      ///< u_n^T M u_n [kg m2] likewise
  double extra_damping_before = 0;   ///< v-^T D v- [W], D the damping beside alpha M + beta K
  double rest_before = 0;            ///< (K u_0)^T (u_0 / 2 - u_n + dt/2 v-) where uniform damping
                                     ///< acts about a rest u_0 [J], if energies are asked for
};

/// Adds the lanes of dofs to the sums of their structure.
template <typename Value>
void add_to(const DofSums<Value>& from, StepSums& sums) {
  sums.stiffness_work += add_up(from.stiffness_work);
  sums.mass_sum += add_up(from.mass_sum);
  sums.filtered += add_up(from.filtered);
}

/// Adds the energies of dofs likewise.
template <typename Value>
void add_to(const DofEnergies<Value>& from, StepSums& sums) {
  sums.kinetic_before += add_up(from.kinetic_before);
  sums.stiffness_before += add_up(from.stiffness_before);
  sums.strain_before += add_up(from.strain_before);
  sums.strain_back += add_up(from.strain_back);
  sums.displacement_mass += add_up(from.displacement_mass);
}

}  // namespace pounding
