#include "dynamics/structure_step.h"

#include <algorithm>
#include <cstddef>

namespace pounding {
namespace {

constexpr std::size_t lanes = sizeof(Lanes) / sizeof(double);
constexpr std::size_t pattern = 3 * lanes;  // dofs

bool directions_are(const LinearSystem& system, std::size_t dof, std::array<int, 3> expected) {
  if (dof + 3 > system.direction.size()) {
    return false;
  }
  for (std::size_t d = 0; d < 3; ++d) {
    if (system.direction[dof + d] != expected[d]) {
      return false;
    }
  }
  return true;
}

/// The number of values that fill a vector; others are given as a number below.
struct AllLanes {};

inline void load_first(const double* from, AllLanes, Lanes& to) {
  load(from, to);
}
inline void store_first(const Lanes& from, AllLanes, double* to) {
  store(to, from);
}
inline void keep_first(AllLanes, Lanes&) {}

/// The others become zero.
inline void load_first(const double* from, std::size_t count, Lanes& to) {
  to = Lanes{from[0], count > 1 ? from[1] : 0, count > 2 ? from[2] : 0, 0};
}
inline void store_first(const Lanes& from, std::size_t count, double* to) {
  to[0] = from[0];
  if (count > 1) to[1] = from[1];
  if (count > 2) to[2] = from[2];
}
inline void keep_first(std::size_t count, Lanes& values) {
  values = Lanes{values[0], count > 1 ? values[1] : 0, count > 2 ? values[2] : 0, 0};
}

/// Masses of the three vectors of a pattern, from one value per node of four nodes.
class NodeMasses {
 public:
  NodeMasses(const double* mass, const double* inverse_mass)
      : mass_(mass), inverse_mass_(inverse_mass) {}

  void begin_pattern(std::size_t number) {
    load(mass_ + number * lanes, values_);
    load(inverse_mass_ + number * lanes, inverses_);
  }
  template <int vector, typename Count>
  void at(Count, Lanes& mass, Lanes& inverse) const {
    constexpr LaneMask places[3]{{0, 0, 0, 1}, {1, 1, 2, 2}, {2, 3, 3, 3}};
    mass = __builtin_shuffle(values_, places[vector]);
    inverse = __builtin_shuffle(inverses_, places[vector]);
  }

 private:
  const double* mass_;
  const double* inverse_mass_;
  Lanes values_{};
  Lanes inverses_{};
};

/// Masses of the three vectors of a pattern, from one value per dof.
class DofMasses {
 public:
  DofMasses(const double* mass, const double* inverse_mass)
      : mass_(mass), inverse_mass_(inverse_mass) {}

  void begin_pattern(std::size_t number) { offset_ = number * pattern; }
  template <int vector, typename Count>
  void at(Count count, Lanes& mass, Lanes& inverse) const {
    load_first(mass_ + offset_ + vector * lanes, count, mass);
    load_first(inverse_mass_ + offset_ + vector * lanes, count, inverse);
  }

 private:
  const double* mass_;
  const double* inverse_mass_;
  std::size_t offset_ = 0;
};

/// The ground's part of the three vectors of a pattern whose directions repeat.
class PatternGround {
 public:
  PatternGround(const Lanes* ground_step, Lanes* momentum)
      : step_{ground_step[0], ground_step[1], ground_step[2]},
        sum_{momentum[0], momentum[1], momentum[2]},
        momentum_(momentum) {}
  ~PatternGround() { std::copy(sum_, sum_ + 3, momentum_); }
  PatternGround(const PatternGround&) = delete;
  PatternGround& operator=(const PatternGround&) = delete;

  template <int vector, typename Count>
  Lanes step(std::size_t, Count count) const {
    Lanes step = step_[vector];
    keep_first(count, step);
    return step;
  }
  template <int vector, typename Count>
  void add(std::size_t, Count, const Lanes& momentum) {
    sum_[vector] += momentum;
  }

 private:
  Lanes step_[3];
  Lanes sum_[3];
  Lanes* momentum_;
};

/// The ground's part of generalised coordinates, each with an influence of its own.
class InfluenceGround {
 public:
  InfluenceGround(const GeneralisedCoordinates& coordinates,
                  const std::array<double, 3>& ground_step, Lanes* momentum)
      : coordinates_(coordinates),
        step_{all_lanes(ground_step[0]), all_lanes(ground_step[1]), all_lanes(ground_step[2])},
        momentum_(momentum) {}

  template <int, typename Count>
  Lanes step(std::size_t i, Count count) const {
    Lanes step{};
    for (std::size_t d = 0; d < 3; ++d) {
      Lanes influence;
      load_first(&coordinates_.influence[d][i], count, influence);
      add_product(step_[d], influence, step);
    }
    return step;
  }
  template <int, typename Count>
  void add(std::size_t i, Count count, const Lanes& momentum) {
    for (std::size_t d = 0; d < 3; ++d) {
      Lanes influence;
      load_first(&coordinates_.influence[d][i], count, influence);
      add_product(influence, momentum, momentum_[d]);
    }
  }

 private:
  const GeneralisedCoordinates& coordinates_;
  Lanes step_[3];
  Lanes* momentum_;
};

}  // namespace

StructureStep::StructureStep(const LinearSystem& system, StructureState& state, double time_step)
    : system_(system), state_(state) {
  terms_.time_step = time_step;
  find_segments(damped_dofs(system));
  if (system.coupled_mass) {
    coupled_ = std::make_unique<CoupledStep>(system, state);
  }
}

double StructureStep::ground_step_at(std::size_t dof) const {
  if (system_.generalised) {
    double step = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      add_product(ground_step_[d], system_.generalised->influence[d][dof], step);
    }
    return step;
  }
  const int direction = system_.direction[dof];
  return direction < 0 ? 0 : ground_step_[direction];
}

void StructureStep::add_momentum(std::size_t dof, double momentum) {
  if (system_.generalised) {
    for (std::size_t d = 0; d < 3; ++d) {
      sums_.momentum[d] += system_.generalised->influence[d][dof] * momentum;
    }
  } else if (system_.direction[dof] >= 0) {
    sums_.momentum[system_.direction[dof]] += momentum;
  }
}

StructureStep::Order StructureStep::order_at(std::size_t dof,
                                             const std::vector<char>& damped) const {
  const auto is_damped = [&](std::size_t from, std::size_t count) {
    return std::any_of(damped.begin() + static_cast<std::ptrdiff_t>(from),
                       damped.begin() + static_cast<std::ptrdiff_t>(from + count),
                       [](char acts) { return acts != 0; });
  };
  if (system_.coupled_mass && system_.coupled_mass->node_of(static_cast<LocalIndex>(dof)) >= 0) {
    return Order::coupled;
  }
  if (is_damped(dof, 1)) {
    return Order::none;
  }
  if (system_.generalised) {
    return Order::generalised;
  }
  if (!directions_are(system_, dof, {0, 1, 2}) || is_damped(dof, 3)) {
    return Order::none;
  }
  if (directions_are(system_, dof + 3, {-1, -1, -1})) {
    return is_damped(dof, 6) ? Order::none : Order::nodes_of_six;
  }
  const double* const mass = &system_.lumped_mass[dof];
  return mass[0] == mass[1] && mass[1] == mass[2] ? Order::translations : Order::none;
}

/// Dofs from `dof` on that are of one order for sure.
std::size_t StructureStep::length_at(std::size_t dof, Order order) const {
  switch (order) {
    case Order::translations:
      return 3;
    case Order::nodes_of_six:
      return 6;
    case Order::coupled: {
      const int node = system_.coupled_mass->node_of(static_cast<LocalIndex>(dof));
      return static_cast<std::size_t>(system_.coupled_mass->nodes()[node].count);
    }
    default:
      return 1;
  }
}

void StructureStep::find_segments(const std::vector<char>& damped) {
  const std::size_t dofs = system_.lumped_mass.size();
  std::size_t coupled = 0;
  for (std::size_t dof = 0; dof < dofs;) {
    const Order order = order_at(dof, damped);
    if (segments_.empty() || segments_.back().order != order) {
      const auto begin = static_cast<LocalIndex>(dof);
      segments_.push_back({begin, begin, order, node_mass_.size(), coupled});
    }
    if (order == Order::translations) {
      node_mass_.push_back(system_.lumped_mass[dof]);
      node_inverse_mass_.push_back(system_.inverse_mass[dof]);
    }
    const std::size_t length = length_at(dof, order);
    coupled += order == Order::coupled ? length : 0;
    dof += length;
    segments_.back().end = static_cast<LocalIndex>(dof);
  }
  node_mass_.resize(node_mass_.size() + lanes, 0.0);  // whole vectors are read
  node_inverse_mass_.resize(node_mass_.size(), 0.0);
}

void StructureStep::begin(double duration, const std::array<double, 3>& ground_acceleration,
                          bool first, bool with_energies) {
  const double dt = terms_.time_step;
  terms_ = {dt, duration, 1 - duration * system_.damping.alpha,
            first ? 0 : 1 / (system_.damping.beta + dt)};
  with_energies_ = with_energies;
  for (std::size_t d = 0; d < 3; ++d) {
    ground_step_[d] = duration * (ground_acceleration[d] - system_.gravity[d]);
  }
  for (std::size_t l = 0; l < pattern; ++l) {
    ground_[0][l / lanes][l % lanes] = ground_step_[l % 3];
    ground_[1][l / lanes][l % lanes] = l % 6 < 3 ? ground_step_[l % 3] : 0;
  }
  for (std::size_t v = 0; v < pattern_vectors; ++v) {
    momentum_[0][v] = momentum_[1][v] = influenced_momentum_[v] = Lanes{};
  }
  vector_sums_ = {};
  dof_sums_ = {};
  vector_energies_ = {};
  dof_energies_ = {};
  sums_ = {};
}

void StructureStep::receive(LocalIndex begin, LocalIndex end, const double* force) {
  auto segment = std::upper_bound(segments_.begin(), segments_.end(), begin,
                                  [](LocalIndex dof, const Segment& s) { return dof < s.end; });
  for (LocalIndex dof = begin; dof < end; ++segment) {
    const LocalIndex stop = std::min(end, segment->end);
    if (with_energies_) {
      advance<true>(*segment, dof, stop, force + (dof - begin));
    } else {
      advance<false>(*segment, dof, stop, force + (dof - begin));
    }
    dof = stop;
  }
}

template <bool with_energies, typename Masses, typename Ground>
void StructureStep::advance_vectors(std::size_t first, std::size_t end, const double* force,
                                    Masses masses, Ground& ground) {
  double* const displacement = state_.displacement.data();
  double* const velocity = state_.velocity.data();
  double* const stiffness = state_.stiffness_displacement.data();
  const StepTerms<Lanes> terms = in_lanes<Lanes>(terms_);
  DofSums<Lanes> sums = vector_sums_;
  const auto advance_vector = [&]<int k>(std::size_t i, const double* from, auto count)
      __attribute__((always_inline)) {
    Lanes q, mass, inverse_mass;
    DofState<Lanes> dof;
    load_first(from, count, q);
    load_first(displacement + i, count, dof.displacement);
    load_first(velocity + i, count, dof.velocity);
    load_first(stiffness + i, count, dof.stiffness_displacement);
    masses.template at<k>(count, mass, inverse_mass);
    if constexpr (with_energies) {
      add_energies(mass, dof, vector_energies_);
    }
    const Lanes free =
        free_velocity(terms, dof.velocity, q, inverse_mass, ground.template step<k>(i, count));
    ground.template add<k>(i, count, settle(terms, q, free, mass, dof, sums));
    store_first(dof.stiffness_displacement, count, stiffness + i);
    store_first(dof.velocity, count, velocity + i);
    store_first(dof.displacement, count, displacement + i);
  };
  constexpr AllLanes all;
  std::size_t i = first, number = 0;
  for (; i + pattern <= end; i += pattern, force += pattern, ++number) {
    masses.begin_pattern(number);
    advance_vector.template operator()<0>(i, force, all);
    advance_vector.template operator()<1>(i + lanes, force + lanes, all);
    advance_vector.template operator()<2>(i + 2 * lanes, force + 2 * lanes, all);
  }
  masses.begin_pattern(number);
  const auto advance_last = [&]<int k>() __attribute__((always_inline)) {
    const std::size_t begin = i + k * lanes;
    if (begin + lanes <= end) {
      advance_vector.template operator()<k>(begin, force + k * lanes, all);
    } else if (begin < end) {
      advance_vector.template operator()<k>(begin, force + k * lanes, end - begin);
    }
  };
  advance_last.template operator()<0>();
  advance_last.template operator()<1>();
  advance_last.template operator()<2>();
  vector_sums_ = sums;
}

template <bool with_energies>
void StructureStep::advance_dofs(std::size_t first, std::size_t end, const double* force) {
  for (std::size_t i = first; i < end; ++i, ++force) {
    DofState<double> dof{state_.displacement[i], state_.velocity[i],
                         state_.stiffness_displacement[i]};
    const double mass = system_.lumped_mass[i];
    const double before = dof.velocity;
    if constexpr (with_energies) {
      add_energies(mass, dof, dof_energies_);
    }
    double after =
        free_velocity(terms_, before, *force, system_.inverse_mass[i], ground_step_at(i));
    if (!state_.extra_force.empty()) {
      subtract_product(terms_.duration, system_.inverse_mass[i] * state_.extra_force[i], after);
      sums_.device += state_.extra_force[i] * (after + before);
    }
    add_momentum(i, settle(terms_, *force, after, mass, dof, dof_sums_));
    state_.displacement[i] = dof.displacement;
    state_.velocity[i] = dof.velocity;
    state_.stiffness_displacement[i] = dof.stiffness_displacement;
  }
}

template <bool with_energies>
void StructureStep::advance(const Segment& segment, LocalIndex begin, LocalIndex end,
                            const double* force) {
  const std::size_t first = begin;
  const std::size_t stop = end;
  const auto offset = first - static_cast<std::size_t>(segment.begin);
  const DofMasses dof_masses(&system_.lumped_mass[first], &system_.inverse_mass[first]);
  switch (segment.order) {
    case Order::coupled:
      coupled_->keep(segment.first_coupled + offset, stop - first, force);
      break;
    case Order::translations: {
      const std::size_t node = segment.first_node + offset / 3;
      PatternGround ground(ground_[0], momentum_[0]);
      advance_vectors<with_energies>(
          first, stop, force, NodeMasses(&node_mass_[node], &node_inverse_mass_[node]), ground);
      break;
    }
    case Order::nodes_of_six: {
      PatternGround ground(ground_[1], momentum_[1]);
      advance_vectors<with_energies>(first, stop, force, dof_masses, ground);
      break;
    }
    case Order::generalised: {
      InfluenceGround ground(*system_.generalised, ground_step_, influenced_momentum_);
      advance_vectors<with_energies>(first, stop, force, dof_masses, ground);
      break;
    }
    case Order::none:
      advance_dofs<with_energies>(first, stop, force);
  }
}

void StructureStep::complete() {
  if (coupled_) {
    coupled_->advance(terms_, ground_step_, with_energies_, dof_sums_, dof_energies_, sums_);
  }
}

void StructureStep::remember(std::span<const LocalIndex> dofs, Before& before) const {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    before.displacement[k] = state_.displacement[i];
    before.velocity[k] = state_.velocity[i];
    before.stiffness_displacement[k] = state_.stiffness_displacement[i];
  }
}

void StructureStep::correct(std::span<const LocalIndex> dofs, const Before& before,
                            std::span<const double> velocity) {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    const double free = state_.velocity[i];
    const double change = velocity[k] - free;
    const double mass = system_.lumped_mass[i];
    const double kv = terms_.inverse > 0
                          ? (state_.stiffness_displacement[i] - before.stiffness_displacement[k]) /
                                terms_.time_step
                          : 0;
    dof_sums_.stiffness_across += change * kv;
    dof_sums_.mass_sum += mass * change * (2 * (free + before.velocity[k]) + change);
    add_momentum(i, mass * change);
    if (!state_.extra_force.empty()) {
      sums_.device += state_.extra_force[i] * change;
    }
    state_.velocity[i] = velocity[k];
    state_.displacement[i] = before.displacement[k];
    add_product(terms_.time_step, velocity[k], state_.displacement[i]);
  }
}

StepSums StructureStep::sums() const {
  StepSums total = sums_;
  add_to(dof_sums_, total);
  add_to(vector_sums_, total);
  add_to(dof_energies_, total);
  add_to(vector_energies_, total);
  for (std::size_t l = 0; l < pattern; ++l) {
    total.momentum[l % 3] += momentum_[0][l / lanes][l % lanes];
    if (l % 6 < 3) {
      total.momentum[l % 3] += momentum_[1][l / lanes][l % lanes];
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    total.momentum[d] += add_up(influenced_momentum_[d]);
  }
  return total;
}

}  // namespace pounding
