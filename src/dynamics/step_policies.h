#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/batch_value.h"
#include "common/wide_lanes.h"
#include "dynamics/damping_filters.h"
#include "dynamics/update.h"

/// Policies by which dofs are brought one step on: the place of their masses, the effect of the
/// ground, and other actions on them. Arrays hold a `Number` for each dof: double, or BatchValue
/// where eight runs are stepped together. The step is made for a `Value` at once: a Number, or a
/// vector of doubles. See StructureStep.
namespace pounding {

/// Dofs in which directions repeat, three vectors of them.
inline constexpr std::size_t step_pattern = 3 * wide_lane_count;

/// The number of values that fill a vector; others are given as a number below.
struct AllLanes {};

inline void load_first(const double* from, AllLanes, WideLanes& to) {
  load(from, to);
}
inline void store_first(const WideLanes& from, AllLanes, double* to) {
  store(to, from);
}
inline void keep_first(AllLanes, WideLanes&) {}
template <typename Number>
void load_first(const Number* from, AllLanes, Number& to) {
  to = *from;
}
/// A number that all runs share.
inline void load_first(const double* from, AllLanes, BatchValue& to) {
  to = all_eight(*from);
}
template <typename Number>
void store_first(const Number& from, AllLanes, Number* to) {
  *to = from;
}

// The others become zero.
#ifdef __AVX512F__

inline __mmask8 first_lanes(std::size_t count) {
  return static_cast<__mmask8>((1U << count) - 1);
}
inline void load_first(const double* from, std::size_t count, WideLanes& to) {
  to = _mm512_maskz_loadu_pd(first_lanes(count), from);
}
inline void store_first(const WideLanes& from, std::size_t count, double* to) {
  _mm512_mask_storeu_pd(to, first_lanes(count), from);
}
inline void keep_first(std::size_t count, WideLanes& values) {
  values = _mm512_maskz_mov_pd(first_lanes(count), values);
}

#else

inline void load_first(const double* from, std::size_t count, WideLanes& to) {
#ifdef __AVX__
  const auto last = static_cast<std::int64_t>(count);
  to = _mm256_maskload_pd(from, (__m256i)(lane_numbers < last));
#else
  to = WideLanes{from[0], count > 1 ? from[1] : 0, count > 2 ? from[2] : 0, 0};
#endif
}
inline void store_first(const WideLanes& from, std::size_t count, double* to) {
  to[0] = from[0];
  if (count > 1) to[1] = from[1];
  if (count > 2) to[2] = from[2];
}
inline void keep_first(std::size_t count, WideLanes& values) {
  values = WideLanes{values[0], count > 1 ? values[1] : 0, count > 2 ? values[2] : 0, 0};
}

#endif

/// The values of nodes at three vectors of their dofs.
template <int vector>
inline WideLanes spread(const WideLanes& of) {
  return [&]<int... lane>(std::integer_sequence<int, lane...>) __attribute__((always_inline)) {
    return __builtin_shufflevector(of, of, (vector * wide_lane_count + lane) / 3 ...);
  }
  (std::make_integer_sequence<int, wide_lane_count>{});
}

/// Masses of the three vectors of a pattern, from one value per node of as many nodes as a vector
/// has lanes.
class NodeMasses {
 public:
  NodeMasses(const double* mass, const double* inverse_mass)
      : mass_(mass), inverse_mass_(inverse_mass) {}

  void begin_pattern(std::size_t number) {
    load(mass_ + number * wide_lane_count, values_);
    load(inverse_mass_ + number * wide_lane_count, inverses_);
  }
  template <int vector, typename Count>
  void at(std::size_t, Count, WideLanes& mass, WideLanes& inverse) const {
    mass = spread<vector>(values_);
    inverse = spread<vector>(inverses_);
  }

 private:
  const double* mass_;
  const double* inverse_mass_;
  WideLanes values_{};
  WideLanes inverses_{};
};

/// Masses from one number per dof.
template <typename Number>
struct DofMasses {
  const Number* mass;  ///< of all dofs, as the next one
  const Number* inverse_mass;

  void begin_pattern(std::size_t) {}
  template <int, typename Count, typename Value>
  void at(std::size_t i, Count count, Value& values, Value& inverse) const {
    load_first(mass + i, count, values);
    load_first(inverse_mass + i, count, inverse);
  }
};

/// Adds the sums of one run to those of its member.
template <typename Number>
void add_to_member(const StepTotals<double>& from, std::size_t member, StepTotals<Number>& to) {
  const auto add = [member](double part, Number& sum) {
    set_member(sum, member, of_member(sum, member) + part);
  };
  add(from.dofs.stiffness_work, to.dofs.stiffness_work);
  add(from.dofs.mass_sum, to.dofs.mass_sum);
  add(from.dofs.filtered, to.dofs.filtered);
  add(from.dofs.device, to.dofs.device);
  add(from.dofs.known_work, to.dofs.known_work);
  for (std::size_t d = 0; d < 3; ++d) add(from.momentum[d], to.momentum[d]);
}

/// The ground's part of the three vectors of a pattern whose directions repeat.
class PatternGround {
 public:
  PatternGround(const WideLanes* ground_step, WideLanes* momentum)
      : step_{ground_step[0], ground_step[1], ground_step[2]},
        sum_{momentum[0], momentum[1], momentum[2]},
        momentum_(momentum) {}
  ~PatternGround() { std::copy(sum_, sum_ + 3, momentum_); }
  PatternGround(const PatternGround&) = delete;
  PatternGround& operator=(const PatternGround&) = delete;

  template <int vector, typename Count>
  WideLanes step(std::size_t, Count count) const {
    WideLanes step = step_[vector];
    keep_first(count, step);
    return step;
  }
  template <int vector, typename Count>
  void add(std::size_t, Count, const WideLanes& momentum) {
    sum_[vector] += momentum;
  }

 private:
  WideLanes step_[3];
  WideLanes sum_[3];
  WideLanes* momentum_;
};

/// The ground's part of generalised coordinates, each with an influence of its own. Directions in
/// which nothing acts, ground nor gravity, are left out, their momentum as well.
template <typename Value, typename Number>
class InfluenceGround {
 public:
  InfluenceGround(const auto& influence, const std::array<Number, 3>& ground_step,
                  const std::array<bool, 3>& shaken, std::array<Value, 3>& momentum)
      : shaken_(shaken), sum_(momentum), momentum_(momentum) {
    for (std::size_t d = 0; d < 3; ++d) {
      influence_[d] = influence[d].data();
      step_[d] = Value{} + ground_step[d];
    }
  }
  ~InfluenceGround() { momentum_ = sum_; }
  InfluenceGround(const InfluenceGround&) = delete;
  InfluenceGround& operator=(const InfluenceGround&) = delete;

  template <int, typename Count>
  Value step(std::size_t i, Count count) const {
    Value step{};
    for (std::size_t d = 0; d < 3; ++d) {
      if (shaken_[d]) add_product(step_[d], influence(d, i, count), step);
    }
    return step;
  }
  template <int, typename Count>
  void add(std::size_t i, Count count, const Value& momentum) {
    for (std::size_t d = 0; d < 3; ++d) {
      if (shaken_[d]) add_product(influence(d, i, count), momentum, sum_[d]);
    }
  }

 private:
  template <typename Count>
  Value influence(std::size_t d, std::size_t i, Count count) const {
    Value influence;
    load_first(influence_[d] + i, count, influence);
    return influence;
  }

  std::array<const Number*, 3> influence_;
  const std::array<bool, 3> shaken_;
  std::array<Value, 3> step_;
  std::array<Value, 3> sum_;
  std::array<Value, 3>& momentum_;
};

/// The ground's part of dofs one by one, by their directions.
template <typename Number>
struct DirectionGround {
  const std::int8_t* direction;
  const std::array<Number, 3>& ground_step;
  std::array<Number, 3>& momentum;

  template <int, typename Count>
  Number step(std::size_t i, Count) const {
    return direction[i] < 0 ? Number{} : ground_step[direction[i]];
  }
  template <int, typename Count>
  void add(std::size_t i, Count, const Number& gained) {
    if (direction[i] >= 0) momentum[direction[i]] += gained;
  }
};

/// Actions on a range beside stiffness and ground, each where there is one. Pointers to numbers of
/// all dofs, null for an action that is not there.
template <typename Number>
struct ActionParts {
  const Number* inelastic_force = nullptr;     ///< p, beside q = K w
  const Number* extra_force = nullptr;         ///< x
  const Number* known_step = nullptr;          ///< see StructureStep
  const Number* stiffness_velocity = nullptr;  ///< see StepRequest
  const Filters<Number>* filters = nullptr;
  std::vector<std::vector<Number>>* memories = nullptr;  ///< with filters
  WaitingDofs<Number>* waiting = nullptr;
  bool settles = false;  ///< those that waited, their velocities being known

  bool any() const {
    return inelastic_force != nullptr || extra_force != nullptr || known_step != nullptr ||
           stiffness_velocity != nullptr || filters != nullptr || waiting != nullptr;
  }
};

/// Those actions on values of dofs; without `any` there are none. Branches, which a processor
/// foresees: a type for each of their combinations takes nearly three times as long to compile.
template <typename Value, typename Number, bool any>
class Actions {
 public:
  explicit Actions(const ActionParts<Number>& parts) : parts_(parts) {
    if (!any || parts.filters == nullptr) return;
    filters_ = in_lanes<Value>(*parts.filters);
    for (std::size_t k = 0; k < filters_.count; ++k) memory_[k] = (*parts.memories)[k].data();
  }

  bool waits() const { return any && parts_.waiting != nullptr && !parts_.settles; }
  bool settles() const { return any && parts_.settles; }

  /// q + p.
  template <typename Count>
  Value resisting(std::size_t i, Count count, const Value& q) const {
    if (!any || parts_.inelastic_force == nullptr) return q;
    return q + at(parts_.inelastic_force, i, count);
  }
  /// f, the memories of the filters being brought on.
  template <typename Count>
  Value filtered(std::size_t i, Count count, const Value& resisting) const {
    if (!any || parts_.filters == nullptr) return resisting;
    Value force = filters_.passing * resisting;
    for (std::size_t k = 0; k < filters_.count; ++k) {
      Value memory = at(memory_[k], i, count);
      pass_filter(filters_.filters[k], resisting, memory, force);
      store_first(memory, count, memory_[k] + i);
    }
    return force;
  }
  template <typename Count>
  void add_energies_before(std::size_t i, Count count, const StepTerms<Value>& terms,
                           const Value& mass, const Value& q, const DofState<Value>& dof,
                           DofEnergies<Value>& energies) const {
    if (!any || parts_.stiffness_velocity == nullptr) return;
    add_energies(terms, mass, q, at(parts_.stiffness_velocity, i, count), dof, energies);
  }
  /// v_free with all actions; `ground_step`: h (a_g - g) iota.
  template <typename Count>
  Value velocity(std::size_t i, Count count, const StepTerms<Value>& terms, const Value& before,
                 const Value& f, const Value& inverse_mass, Value ground_step) const {
    if (any && parts_.known_step != nullptr) ground_step += at(parts_.known_step, i, count);
    Value after = free_velocity(terms, before, f, inverse_mass, ground_step);
    if (any && parts_.extra_force != nullptr) {
      subtract_product(terms.duration, inverse_mass * at(parts_.extra_force, i, count), after);
    }
    return after;
  }
  /// Impulse on dofs whose mass is coupled, M (v_free - v-) if it were not.
  template <typename Count>
  [[gnu::always_inline]] Value impulse(std::size_t i, Count count, const StepTerms<Value>& terms,
                                       const Value& before, const Value& q, const Value& f,
                                       const Value& mass, const Value& ground_step) const {
    const bool filters = parts_.filters != nullptr;
    Value impulse =
        -(mass * (terms.drag * before + ground_step)) - terms.duration * (filters ? f : q);
    const auto take = [&](const Value& factor, const Number* action) {
      if (action != nullptr) impulse = impulse - factor * at(action, i, count);
    };
    if (!filters) take(terms.duration, parts_.inelastic_force);
    take(terms.duration, parts_.extra_force);
    take(mass, parts_.known_step);
    return impulse;
  }
  template <typename Count>
  void keep(std::size_t i, Count count, const Value& q, const Value& f,
            const Value& velocity) const {
    store_first(q, count, &parts_.waiting->stiffness[i]);
    if (parts_.filters != nullptr) store_first(f, count, &parts_.waiting->acting[i]);
    store_first(velocity, count, &parts_.waiting->velocity[i]);
  }
  template <typename Count>
  void take_back(std::size_t i, Count count, Value& f, Value& velocity) const {
    if (parts_.filters != nullptr) f = at(parts_.waiting->acting.data(), i, count);
    velocity = at(parts_.waiting->velocity.data(), i, count);
  }
  /// Adds the works of the actions on s = v+ + v-; `momentum`: M s.
  template <typename Count>
  void add_works(std::size_t i, Count count, const Value& f, const Value& resisting, const Value& s,
                 const Value& momentum, DofSums<Value>& sums) const {
    if (!any) return;
    if (parts_.filters != nullptr) sums.filtered += (f - resisting) * s;
    if (parts_.extra_force != nullptr) sums.device += at(parts_.extra_force, i, count) * s;
    if (parts_.known_step != nullptr) {
      add_product(at(parts_.known_step, i, count), momentum, sums.known_work);
    }
  }

 private:
  template <typename Count>
  static Value at(const Number* numbers, std::size_t i, Count count) {
    Value value;
    load_first(numbers + i, count, value);
    return value;
  }

  const ActionParts<Number>& parts_;
  Filters<Value> filters_;
  std::array<Number*, max_filters> memory_;
};

}  // namespace pounding
