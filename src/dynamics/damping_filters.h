#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/batch_value.h"
#include "common/lanes.h"
#include "dynamics/state.h"
#include "system/linear_system.h"

namespace pounding {

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
template <typename Value, typename Number>
Filters<Value> in_lanes(const Filters<Number>& filters) {
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
template <typename Number, typename Memory>
Number filtered_force(const Filters<Number>& filters, const Number& stiffness_force,
                      const Memory& memory) {
  Number force = filters.passing * stiffness_force;
  for (std::size_t i = 0; i < filters.count; ++i) {
    subtract_product(filters.filters[i].weight, memory(i), force);
  }
  return force;
}

/// Filters of a run in a batch; those that it lacks let everything pass.
template <typename Number>
void put_filters(const Filters<double>& from, std::size_t member, Filters<Number>& to) {
  to.count = std::max(to.count, from.count);
  set_member(to.passing, member, from.passing);
  for (std::size_t k = 0; k < from.count; ++k) {
    set_member(to.filters[k].weight, member, from.filters[k].weight);
    set_member(to.filters[k].keep, member, from.filters[k].keep);
    set_member(to.filters[k].take, member, from.filters[k].take);
  }
}

/// Numbers of the filters of a system's uniform damping; none without.
Filters<double> filters_of(const LinearSystem& system, double time_step);

/// Memories of the filters of a structure that has stood at u_0 for ever: W_i = K u_0. Collective
/// over the system's communicator.
void start_filters(const LinearSystem& system, double time_step, StructureState& state);

}  // namespace pounding
