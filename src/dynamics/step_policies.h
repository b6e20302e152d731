#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "common/wide_lanes.h"
#include "dynamics/update.h"
#include "system/linear_system.h"

/// Policies by which vectors of dofs are brought one step on: the place of their masses, the effect
/// of the ground, and other actions on them. See StructureStep.
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

/// The values of nodes at three vectors of their dofs.
template <int vector>
inline WideLanes spread(const WideLanes& of) {
  if constexpr (vector == 0) {
    return __builtin_shufflevector(of, of, 0, 0, 0, 1, 1, 1, 2, 2);
  } else if constexpr (vector == 1) {
    return __builtin_shufflevector(of, of, 2, 3, 3, 3, 4, 4, 4, 5);
  } else {
    return __builtin_shufflevector(of, of, 5, 5, 6, 6, 6, 7, 7, 7);
  }
}

#else

inline void load_first(const double* from, std::size_t count, WideLanes& to) {
  to = WideLanes{from[0], count > 1 ? from[1] : 0, count > 2 ? from[2] : 0, 0};
}
inline void store_first(const WideLanes& from, std::size_t count, double* to) {
  to[0] = from[0];
  if (count > 1) to[1] = from[1];
  if (count > 2) to[2] = from[2];
}
inline void keep_first(std::size_t count, WideLanes& values) {
  values = WideLanes{values[0], count > 1 ? values[1] : 0, count > 2 ? values[2] : 0, 0};
}

/// The values of nodes at three vectors of their dofs.
template <int vector>
inline WideLanes spread(const WideLanes& of) {
  if constexpr (vector == 0) {
    return __builtin_shufflevector(of, of, 0, 0, 0, 1);
  } else if constexpr (vector == 1) {
    return __builtin_shufflevector(of, of, 1, 1, 2, 2);
  } else {
    return __builtin_shufflevector(of, of, 2, 3, 3, 3);
  }
}

#endif

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
  void at(Count, WideLanes& mass, WideLanes& inverse) const {
    mass = spread<vector>(values_);
    inverse = spread<vector>(inverses_);
  }

 private:
  const double* mass_;
  const double* inverse_mass_;
  WideLanes values_{};
  WideLanes inverses_{};
};

/// Masses of the three vectors of a pattern, from one value per dof.
class DofMasses {
 public:
  DofMasses(const double* mass, const double* inverse_mass)
      : mass_(mass), inverse_mass_(inverse_mass) {}

  void begin_pattern(std::size_t number) { offset_ = number * step_pattern; }
  template <int vector, typename Count>
  void at(Count count, WideLanes& mass, WideLanes& inverse) const {
    load_first(mass_ + offset_ + vector * wide_lane_count, count, mass);
    load_first(inverse_mass_ + offset_ + vector * wide_lane_count, count, inverse);
  }

 private:
  const double* mass_;
  const double* inverse_mass_;
  std::size_t offset_ = 0;
};

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

/// The ground's part of generalised coordinates, each with an influence of its own.
class InfluenceGround {
 public:
  InfluenceGround(const GeneralisedCoordinates& coordinates,
                  const std::array<double, 3>& ground_step, WideLanes* momentum)
      : coordinates_(coordinates),
        step_{all_wide(ground_step[0]), all_wide(ground_step[1]), all_wide(ground_step[2])},
        momentum_(momentum) {}

  template <int, typename Count>
  WideLanes step(std::size_t i, Count count) const {
    WideLanes step{};
    for (std::size_t d = 0; d < 3; ++d) {
      WideLanes influence;
      load_first(&coordinates_.influence[d][i], count, influence);
      add_product(step_[d], influence, step);
    }
    return step;
  }
  template <int, typename Count>
  void add(std::size_t i, Count count, const WideLanes& momentum) {
    for (std::size_t d = 0; d < 3; ++d) {
      WideLanes influence;
      load_first(&coordinates_.influence[d][i], count, influence);
      add_product(influence, momentum, momentum_[d]);
    }
  }

 private:
  const GeneralisedCoordinates& coordinates_;
  WideLanes step_[3];
  WideLanes* momentum_;
};

/// Where nothing but stiffness and ground acts.
struct NothingElse {
  template <typename Count>
  WideLanes resisting(std::size_t, Count, const WideLanes& q) const {
    return q;
  }
  template <typename Count>
  WideLanes filtered(std::size_t, Count, const WideLanes& q) const {
    return q;
  }
  template <typename Count>
  void add_known_step(std::size_t, Count, WideLanes&) const {}
  void add_filtered_work(const WideLanes&, const WideLanes&, const WideLanes&) {}
  template <typename Count>
  void add_known_work(std::size_t, Count, const WideLanes&) {}
};

/// Other actions on a range, each where there is one: forces g of inelastic elements beside
/// q = K u, filters of uniform damping with their memories, and the known steps of supports which
/// move on their own and of loads, h ( sum_c iota_c r_c'' - M^-1 sum_l f_l p_l ). Branches, which a
/// processor foresees: a type for each of their combinations takes nearly three times as long to
/// compile.
class OtherActions {
 public:
  /// Pointers to values of all dofs; null for an action that is not there. The works gain the sums
  /// over these dofs of (f - q - g) (v+ + v-), and of known steps times M s.
  struct Parts {
    const double* inelastic_force = nullptr;
    const Filters<double>* filters = nullptr;
    std::vector<std::vector<double>>* memories = nullptr;  ///< with filters
    const double* known_step = nullptr;
    WideLanes* filtered_work = nullptr;
    WideLanes* known_work = nullptr;
  };

  explicit OtherActions(const Parts& parts)
      : parts_(parts), filtered_work_(*parts.filtered_work), known_work_(*parts.known_work) {
    if (parts.filters == nullptr) return;
    filters_ = in_lanes<WideLanes>(*parts.filters);
    for (std::size_t k = 0; k < filters_.count; ++k) memory_[k] = (*parts.memories)[k].data();
  }
  ~OtherActions() {
    *parts_.filtered_work = filtered_work_;
    *parts_.known_work = known_work_;
  }
  OtherActions(const OtherActions&) = delete;
  OtherActions& operator=(const OtherActions&) = delete;

  template <typename Count>
  WideLanes resisting(std::size_t i, Count count, const WideLanes& q) const {
    if (parts_.inelastic_force == nullptr) return q;
    WideLanes force;
    load_first(parts_.inelastic_force + i, count, force);
    return q + force;
  }
  template <typename Count>
  WideLanes filtered(std::size_t i, Count count, const WideLanes& q) const {
    if (parts_.filters == nullptr) return q;
    WideLanes force = filters_.passing * q;
    for (std::size_t k = 0; k < filters_.count; ++k) {
      WideLanes memory;
      load_first(memory_[k] + i, count, memory);
      pass_filter(filters_.filters[k], q, memory, force);
      store_first(memory, count, memory_[k] + i);
    }
    return force;
  }
  template <typename Count>
  void add_known_step(std::size_t i, Count count, WideLanes& step) const {
    if (parts_.known_step == nullptr) return;
    WideLanes known;
    load_first(parts_.known_step + i, count, known);
    step += known;
  }
  void add_filtered_work(const WideLanes& f, const WideLanes& resisting, const WideLanes& sum) {
    if (parts_.filters != nullptr) filtered_work_ += (f - resisting) * sum;
  }
  template <typename Count>
  void add_known_work(std::size_t i, Count count, const WideLanes& momentum) {
    if (parts_.known_step == nullptr) return;
    WideLanes known;
    load_first(parts_.known_step + i, count, known);
    add_product(known, momentum, known_work_);
  }

 private:
  const Parts parts_;
  Filters<WideLanes> filters_{};
  std::array<double*, max_filters> memory_{};
  WideLanes filtered_work_;
  WideLanes known_work_;
};

}  // namespace pounding
