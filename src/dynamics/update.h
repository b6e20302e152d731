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
///     K v-    = (q - K u_{n-1}) / (beta + dt)
///     K u_n   = K u_{n-1} + dt K v-
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
  Value inverse;    ///< 1 / (beta + dt) [1/s]; 0 in the first step, whose K u_{n-1} is K u_n
};

/// Copies the terms into every lane of `Value`.
template <typename Value>
StepTerms<Value> in_lanes(const StepTerms<double>& terms) {
  const Value zero{};
  return {zero + terms.time_step, zero + terms.duration, zero + terms.decay, zero + terms.inverse};
}

/// State of dofs between two steps; see StructureState.
template <typename Value>
struct DofState {
  Value displacement;
  Value velocity;
  Value stiffness_displacement;
};

/// Sums that a step leaves for the energy balance, lane by lane; see StepSums.
template <typename Value>
struct DofSums {
  Value stiffness_before{};
  Value stiffness_across{};
  Value mass_sum{};
  Value filtered{};  ///< of (f - q) (v+ + v-)
};

/// Most filters of uniform damping.
constexpr std::size_t max_filters = 8;

/// Numbers of the filters of uniform damping that all dofs of a structure share. With Q_n = K u_n,
/// beta = 0 and W_i the memory of filter i,
///
///     W_i <- ((1 - c_i) W_i + c_i (Q_n + Q_{n-1})) / (1 + c_i),      c_i = omega_i dt / 2
///     f   = s ( Q_n + sum_i a_i (Q_n - W_i) )
///
/// the trapezoidal rule for dW/dt = omega_i (Q - W). Stable if and only if M - dt^2/4 s (1 + sum
/// a_i) K is positive definite; docs/theory.md has the energy that proves it.
template <typename Value>
struct Filters {
  std::size_t count = 0;
  Value at_once;  ///< s (1 + sum a_i)
  struct Filter {
    Value weight;  ///< s a_i
    Value keep;    ///< (1 - c_i) / (1 + c_i)
    Value take;    ///< c_i / (1 + c_i)
  };
  std::array<Filter, max_filters> filters;
};

/// Copies the numbers into every lane of `Value`.
template <typename Value>
Filters<Value> in_lanes(const Filters<double>& filters) {
  const Value zero{};
  Filters<Value> copy{filters.count, zero + filters.at_once, {}};
  for (std::size_t i = 0; i < filters.count; ++i) {
    const auto& [weight, keep, take] = filters.filters[i];
    copy.filters[i] = {zero + weight, zero + keep, zero + take};
  }
  return copy;
}

/// Brings the memory of one filter from n - 1 to n, and takes its part off the force f.
template <typename Value>
[[gnu::always_inline]] inline void pass_filter(const typename Filters<Value>::Filter& filter,
                                               Value both, Value& memory, Value& force) {
  Value passed{};
  add_product(filter.keep, memory, passed);
  add_product(filter.take, both, passed);
  memory = passed;
  subtract_product(filter.weight, passed, force);
}

/// Energies before the step likewise, where they are asked for.
template <typename Value>
struct DofEnergies {
  Value kinetic_before{};
  Value strain_before{};
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

/// Adds the energies before the step: v-^T M v-, u_n^T K u_{n-1}, u_n^T M u_n.
template <typename Value>
[[gnu::always_inline]] inline void add_energies(Value mass, const DofState<Value>& dof,
                                                DofEnergies<Value>& energies) {
  energies.kinetic_before += mass * dof.velocity * dof.velocity;
  energies.strain_before += dof.displacement * dof.stiffness_displacement;
  energies.displacement_mass += mass * dof.displacement * dof.displacement;
}

/// Brings the dof to the end of the step with v+ = `after`, adds to the sums, and returns
/// M (v+ + v-) [kg m/s, kg m2/s].
template <typename Value>
[[gnu::always_inline]] inline Value settle(const StepTerms<Value>& terms, Value force, Value after,
                                           Value mass, DofState<Value>& dof, DofSums<Value>& sums) {
  const Value before = dof.velocity;
  const Value rate = (force - dof.stiffness_displacement) * terms.inverse;  // K v-
  add_product(terms.time_step, rate, dof.stiffness_displacement);
  add_product(terms.time_step, after, dof.displacement);
  dof.velocity = after;
  add_product(before, rate, sums.stiffness_before);
  add_product(after, rate, sums.stiffness_across);
  const Value sum = after + before;
  const Value momentum = mass * sum;
  add_product(momentum, sum, sums.mass_sum);
  return momentum;
}

}  // namespace pounding
