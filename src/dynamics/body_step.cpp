#include "dynamics/body_step.h"

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

/// The same from one value per dof.
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

}  // namespace

BodyStep::BodyStep(const LinearSystem& system, BodyState& state, double time_step)
    : system_(system), state_(state), time_step_(time_step) {
  find_segments();
  if (system.coupled_mass) {
    coupled_ = std::make_unique<CoupledStep>(system, state, time_step);
  }
}

double BodyStep::ground_step_at(std::size_t dof) const {
  if (system_.generalised) {
    const auto& iota = system_.generalised->influence;
    return ground_step_[0] * iota[0][dof] + ground_step_[1] * iota[1][dof] +
           ground_step_[2] * iota[2][dof];
  }
  const int direction = system_.direction[dof];
  return direction < 0 ? 0 : ground_step_[static_cast<std::size_t>(direction)];
}

void BodyStep::add_momentum(std::size_t dof, double momentum) {
  if (system_.generalised) {
    for (std::size_t d = 0; d < 3; ++d) {
      single_.momentum[d] += system_.generalised->influence[d][dof] * momentum;
    }
  } else if (system_.direction[dof] >= 0) {
    single_.momentum[static_cast<std::size_t>(system_.direction[dof])] += momentum;
  }
}

BodyStep::Order BodyStep::order_at(std::size_t dof) const {
  if (system_.generalised && !system_.has_devices()) {
    return Order::generalised;
  }
  if (system_.coupled_mass && system_.coupled_mass->node_of(static_cast<LocalIndex>(dof)) >= 0) {
    return Order::coupled;
  }
  if (system_.has_devices() || !directions_are(system_, dof, {0, 1, 2})) {
    return Order::none;
  }
  if (directions_are(system_, dof + 3, {-1, -1, -1})) {
    return Order::nodes_of_six;
  }
  const double* const mass = &system_.lumped_mass[dof];
  return mass[0] == mass[1] && mass[1] == mass[2] ? Order::translations : Order::none;
}

/// Dofs from `dof` on that are of one order for sure.
std::size_t BodyStep::length_at(std::size_t dof, Order order) const {
  switch (order) {
    case Order::translations:
      return 3;
    case Order::nodes_of_six:
      return 6;
    case Order::coupled: {
      const int node = system_.coupled_mass->node_of(static_cast<LocalIndex>(dof));
      return static_cast<std::size_t>(
          system_.coupled_mass->nodes()[static_cast<std::size_t>(node)].count);
    }
    default:
      return 1;
  }
}

void BodyStep::find_segments() {
  const std::size_t dofs = system_.lumped_mass.size();
  std::size_t coupled = 0;
  for (std::size_t dof = 0; dof < dofs;) {
    const Order order = order_at(dof);
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

void BodyStep::begin(double duration, const std::array<double, 3>& ground_acceleration, bool first,
                     bool with_energies) {
  duration_ = duration;
  decay_ = 1 - duration * system_.damping.alpha;
  inverse_ = first ? 0 : 1 / (system_.damping.beta + time_step_);
  with_energies_ = with_energies;
  for (std::size_t d = 0; d < 3; ++d) {
    ground_step_[d] = duration * (ground_acceleration[d] - system_.gravity[d]);
  }
  for (std::size_t l = 0; l < pattern; ++l) {
    ground_[0][l / lanes][l % lanes] = ground_step_[l % 3];
    ground_[1][l / lanes][l % lanes] = l % 6 < 3 ? ground_step_[l % 3] : 0;
  }
  sums_ = {};
  single_ = {};
}

void BodyStep::receive(LocalIndex begin, LocalIndex end, const double* force) {
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

template <bool with_energies, typename Masses>
void BodyStep::advance_patterns(std::size_t first, std::size_t end, const double* force,
                                Masses masses, const Lanes* ground, Lanes* momentum) {
  double* const displacement = state_.displacement.data();
  double* const velocity = state_.velocity.data();
  double* const stiffness = state_.stiffness_displacement.data();
  const Lanes time_step = all_lanes(time_step_);
  const Lanes decay = all_lanes(decay_);
  const Lanes inverse = all_lanes(inverse_);
  const Lanes ground_step[3]{ground[0], ground[1], ground[2]};
  Lanes momentum_sum[3]{momentum[0], momentum[1], momentum[2]};
  Lanes stiffness_before = sums_.stiffness_before;
  Lanes stiffness_across = sums_.stiffness_across;
  Lanes mass_sum = sums_.mass_sum;
  const auto advance_vector = [&]<int k>(std::size_t i, const double* from, auto count)
      __attribute__((always_inline)) {
    Lanes q, u, v, ku, weight, m;
    load_first(from, count, q);
    load_first(displacement + i, count, u);
    load_first(velocity + i, count, v);
    load_first(stiffness + i, count, ku);
    masses.template at<k>(count, m, weight);
    if constexpr (with_energies) {
      sums_.kinetic_before += m * v * v;
      sums_.strain_before += u * ku;
      sums_.displacement_mass += m * u * u;
    }
    const Lanes kv = (q - ku) * inverse;
    Lanes after = -ground_step[k];
    keep_first(count, after);
    add_product(decay, v, after);
    subtract_product(time_step, weight * q, after);
    add_product(time_step, kv, ku);
    add_product(time_step, after, u);
    store_first(ku, count, stiffness + i);
    store_first(after, count, velocity + i);
    store_first(u, count, displacement + i);
    add_product(v, kv, stiffness_before);
    add_product(after, kv, stiffness_across);
    const Lanes sum = after + v;
    const Lanes both = m * sum;
    add_product(both, sum, mass_sum);
    momentum_sum[k] += both;
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
  std::copy(momentum_sum, momentum_sum + 3, momentum);
  sums_.stiffness_before = stiffness_before;
  sums_.stiffness_across = stiffness_across;
  sums_.mass_sum = mass_sum;
}

template <bool with_energies>
void BodyStep::advance_generalised(std::size_t first, std::size_t end, const double* force) {
  double* const displacement = state_.displacement.data();
  double* const velocity = state_.velocity.data();
  double* const stiffness = state_.stiffness_displacement.data();
  const auto& influence = system_.generalised->influence;
  const Lanes time_step = all_lanes(time_step_), decay = all_lanes(decay_);
  const Lanes ground_step[3]{all_lanes(ground_step_[0]), all_lanes(ground_step_[1]),
                             all_lanes(ground_step_[2])};
  const double inverse = inverse_;
  Lanes stiffness_before{}, stiffness_across{}, mass_sum{};
  Lanes momentum[3]{};
  for (std::size_t i = first; i + lanes <= end; i += lanes, force += lanes) {
    Lanes q, v, u, ku, m, weight, iota[3];
    load(force, q);
    load(displacement + i, u);
    load(velocity + i, v);
    load(stiffness + i, ku);
    load(&system_.lumped_mass[i], m);
    load(&system_.inverse_mass[i], weight);
    for (std::size_t d = 0; d < 3; ++d) {
      load(&influence[d][i], iota[d]);
    }
    if constexpr (with_energies) {
      sums_.kinetic_before += m * v * v;
      sums_.strain_before += u * ku;
      sums_.displacement_mass += m * u * u;
    }
    const Lanes kv = (q - ku) * inverse;
    Lanes after = decay * v;
    subtract_product(time_step, weight * q, after);
    for (std::size_t d = 0; d < 3; ++d) {
      subtract_product(ground_step[d], iota[d], after);
    }
    add_product(time_step, kv, ku);
    add_product(time_step, after, u);
    store(stiffness + i, ku);
    store(velocity + i, after);
    store(displacement + i, u);
    add_product(v, kv, stiffness_before);
    add_product(after, kv, stiffness_across);
    const Lanes sum = after + v;
    const Lanes both = m * sum;
    add_product(both, sum, mass_sum);
    for (std::size_t d = 0; d < 3; ++d) {
      add_product(iota[d], both, momentum[d]);
    }
  }
  single_.stiffness_before += add_up(stiffness_before);
  single_.stiffness_across += add_up(stiffness_across);
  single_.mass_sum += add_up(mass_sum);
  for (std::size_t d = 0; d < 3; ++d) {
    single_.momentum[d] += add_up(momentum[d]);
  }
}

template <bool with_energies>
void BodyStep::advance(const Segment& segment, LocalIndex begin, LocalIndex end,
                       const double* force) {
  std::size_t done = static_cast<std::size_t>(begin);
  const auto stop = static_cast<std::size_t>(end);
  if (segment.order == Order::coupled) {
    coupled_->keep(segment.first_coupled + static_cast<std::size_t>(begin - segment.begin),
                   stop - done, force);
    return;
  }
  if (segment.order == Order::translations && duration_ == time_step_) {
    const std::size_t node =
        segment.first_node + (done - static_cast<std::size_t>(segment.begin)) / pattern_lanes;
    advance_patterns<with_energies>(done, stop, force,
                                    NodeMasses(&node_mass_[node], &node_inverse_mass_[node]),
                                    ground_[0], sums_.momentum[0]);
    return;
  }
  if (segment.order == Order::nodes_of_six && duration_ == time_step_) {
    advance_patterns<with_energies>(
        done, stop, force, DofMasses(&system_.lumped_mass[done], &system_.inverse_mass[done]),
        ground_[1], sums_.momentum[1]);
    return;
  }
  if (segment.order == Order::generalised && duration_ == time_step_) {
    advance_generalised<with_energies>(done, stop, force);
    done += (stop - done) / lanes * lanes;
  }
  for (; done < stop; ++done) {
    advance_dof<with_energies>(static_cast<LocalIndex>(done),
                               force[done - static_cast<std::size_t>(begin)]);
  }
}

template <bool with_energies>
void BodyStep::advance_dof(LocalIndex dof, double force) {
  const auto i = static_cast<std::size_t>(dof);
  const double before = state_.velocity[i];
  const double mass = system_.lumped_mass[i];
  double& ku = state_.stiffness_displacement[i];
  if constexpr (with_energies) {
    single_.kinetic_before += mass * before * before;
    single_.strain_before += state_.displacement[i] * ku;
    single_.displacement_mass += mass * state_.displacement[i] * state_.displacement[i];
  }
  const double kv = (force - ku) * inverse_;
  double after = -ground_step_at(i);
  add_product(decay_, before, after);
  subtract_product(duration_, system_.inverse_mass[i] * force, after);
  if (!state_.device_force.empty()) {
    subtract_product(duration_, system_.inverse_mass[i] * state_.device_force[i], after);
    single_.device += state_.device_force[i] * (after + before);
  }
  add_momentum(i, mass * (after + before));
  add_product(time_step_, kv, ku);
  add_product(time_step_, after, state_.displacement[i]);
  state_.velocity[i] = after;
  single_.stiffness_before += before * kv;
  single_.stiffness_across += after * kv;
  single_.mass_sum += mass * (after + before) * (after + before);
}

void BodyStep::complete() {
  if (coupled_) {
    coupled_->advance({duration_, inverse_, ground_step_}, with_energies_, single_);
  }
}

void BodyStep::remember(std::span<const LocalIndex> dofs, Before& before) const {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const auto i = static_cast<std::size_t>(dofs[k]);
    before.displacement[k] = state_.displacement[i];
    before.velocity[k] = state_.velocity[i];
    before.stiffness_displacement[k] = state_.stiffness_displacement[i];
  }
}

void BodyStep::correct(std::span<const LocalIndex> dofs, const Before& before,
                       std::span<const double> velocity) {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const auto i = static_cast<std::size_t>(dofs[k]);
    const double free = state_.velocity[i];
    const double change = velocity[k] - free;
    const double mass = system_.lumped_mass[i];
    const double kv =
        inverse_ > 0
            ? (state_.stiffness_displacement[i] - before.stiffness_displacement[k]) / time_step_
            : 0;
    single_.stiffness_across += change * kv;
    single_.mass_sum += mass * change * (2 * (free + before.velocity[k]) + change);
    add_momentum(i, mass * change);
    if (!state_.device_force.empty()) {
      single_.device += state_.device_force[i] * change;
    }
    state_.velocity[i] = velocity[k];
    state_.displacement[i] = before.displacement[k];
    add_product(time_step_, velocity[k], state_.displacement[i]);
  }
}

StepSums BodyStep::sums() const {
  StepSums total = single_;
  total.stiffness_before += add_up(sums_.stiffness_before);
  total.stiffness_across += add_up(sums_.stiffness_across);
  total.mass_sum += add_up(sums_.mass_sum);
  total.kinetic_before += add_up(sums_.kinetic_before);
  total.strain_before += add_up(sums_.strain_before);
  total.displacement_mass += add_up(sums_.displacement_mass);
  for (std::size_t l = 0; l < pattern; ++l) {
    total.momentum[l % 3] += sums_.momentum[0][l / lanes][l % lanes];
    if (l % 6 < 3) {
      total.momentum[l % 3] += sums_.momentum[1][l / lanes][l % lanes];
    }
  }
  return total;
}

}  // namespace pounding
