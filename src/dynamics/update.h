#pragma once

#include <array>
#include <cstddef>

#include "common/lanes.h"

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
/// Stable if and only if M - dt^2/4 s (1 + sum a_i) K is positive definite; docs/theory/damping.md
/// has the energy that proves it.
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

}  // namespace pounding
