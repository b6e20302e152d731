#pragma once

#include <cstddef>
#include <type_traits>

#include "dynamics/state.h"
#include "dynamics/step_policies.h"

namespace pounding {

/// Calls `advance<k>` for the dofs [first, end), a vector at a time, k its place in the pattern of
/// the masses.
template <typename Number, typename Masses, typename Advance>
__attribute__((always_inline)) inline void in_patterns(std::size_t first, std::size_t end,
                                                       const Number* force, Masses& masses,
                                                       const Advance& advance) {
  constexpr AllLanes whole;
  constexpr std::size_t lanes = wide_lane_count;
  std::size_t i = first, number = 0;
  for (; i + step_pattern <= end; i += step_pattern, force += step_pattern, ++number) {
    masses.begin_pattern(number);
    advance.template operator()<0>(i, force, whole);
    advance.template operator()<1>(i + lanes, force + lanes, whole);
    advance.template operator()<2>(i + 2 * lanes, force + 2 * lanes, whole);
  }
  masses.begin_pattern(number);
  const auto advance_last = [&]<int k>() __attribute__((always_inline)) {
    const std::size_t begin = i + k * lanes;
    if (begin + lanes <= end) {
      advance.template operator()<k>(begin, force + k * lanes, whole);
    } else if (begin < end) {
      advance.template operator()<k>(begin, force + k * lanes, end - begin);
    }
  };
  advance_last.template operator()<0>();
  advance_last.template operator()<1>();
  advance_last.template operator()<2>();
}

/// Brings the dofs [first, end) of a structure one step on, by values: numbers or vectors, with the
/// forces q from force[0] on. Policies give other actions, masses, and the effect of the ground.
template <typename Number, typename Actions, typename Masses, typename Ground, typename Value>
void advance_values(StateOf<Number>& state, const StepTerms<Number>& all, std::size_t first,
                    std::size_t end, const Number* force, const Actions& others, Masses masses,
                    Ground& ground, StepTotals<Value>& totals) {
  Number* const displacement = state.displacement.data();
  Number* const velocity = state.velocity.data();
  const StepTerms<Value> terms = in_lanes<Value>(all);
  DofSums<Value>& kept = totals.dofs;
  // One by one: a copy of the whole is a call, and its sums stay in memory.
  DofSums<Value> sums{kept.stiffness_work, kept.mass_sum, kept.filtered, kept.device,
                      kept.known_work};
  const auto advance_value = [&]<int k>(std::size_t i, const Number* from, auto count)
      __attribute__((always_inline)) {
    Value q, f{}, mass, inverse_mass, after;
    DofState<Value> dof;
    load_first(from, count, q);
    load_first(displacement + i, count, dof.displacement);
    load_first(velocity + i, count, dof.velocity);
    masses.template at<k>(i, count, mass, inverse_mass);
    const Value before = dof.velocity;
    const Value resisting = others.resisting(i, count, q);
    if (others.settles()) {
      others.take_back(i, count, f, after);
    } else {
      others.add_energies_before(i, count, terms, mass, q, dof, totals.energies);
      f = others.filtered(i, count, resisting);
      const Value step = ground.template step<k>(i, count);
      if (others.waits()) {
        // Only the mass of single runs is coupled: eight wait for the dashpots that brake them.
        after = std::is_same_v<Number, double>
                    ? others.impulse(i, count, terms, before, q, f, mass, step)
                    : others.velocity(i, count, terms, before, f, inverse_mass, step);
        return others.keep(i, count, q, f, after);
      }
      after = others.velocity(i, count, terms, before, f, inverse_mass, step);
    }
    const Value momentum = settle(terms, q, after, mass, dof, sums);
    others.add_works(i, count, f, resisting, after + before, momentum, sums);
    ground.template add<k>(i, count, momentum);
    store_first(dof.velocity, count, velocity + i);
    store_first(dof.displacement, count, displacement + i);
  };
  constexpr AllLanes whole;
  if constexpr (std::is_same_v<Value, Number>) {
    for (std::size_t i = first; i < end; ++i, ++force) {
      advance_value.template operator()<0>(i, force, whole);
    }
  } else {
    in_patterns(first, end, force, masses, advance_value);
  }
  kept = {sums.stiffness_work, sums.mass_sum, sums.filtered, sums.device, sums.known_work};
}

}  // namespace pounding
