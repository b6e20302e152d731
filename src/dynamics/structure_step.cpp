#include "dynamics/structure_step.h"

#include <algorithm>
#include <cstddef>

#include "common/wide_lanes.h"
#include "dynamics/state.h"
#include "dynamics/step_policies.h"
#include "dynamics/update.h"
#include "system/load_shapes.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

constexpr std::size_t lanes = wide_lane_count;
constexpr std::size_t pattern = step_pattern;

bool directions_are(const LinearSystem& system, std::size_t dof, std::array<int, 3> expected) {
  if (dof + 3 > system.direction.size()) return false;
  for (std::size_t d = 0; d < 3; ++d) {
    if (system.direction[dof + d] != expected[d]) return false;
  }
  return true;
}

}  // namespace

struct StructureStep::VectorParts {
  static constexpr std::size_t count = 3;  ///< vectors of a pattern

  WideLanes known_work{};     ///< sum of known_step_ times M s
  WideLanes filtered_work{};  ///< sum of (f - q) (v+ + v-)
  /// Patterns of nodes without and with rotations: h (a_g - g) iota, and the sums of M s.
  WideLanes ground[2][count]{};
  WideLanes momentum[2][count]{};
  WideLanes influenced_momentum[3]{};  ///< iota_d^T M s of generalised coordinates
  DofSums<WideLanes> sums;
  DofEnergies<WideLanes> energies;
};

Filters<double> filters_of(const LinearSystem& system, double time_step) {
  Filters<double> result{0, 1, {}};
  if (system.uniform_damping) {
    const double at_rest = system.uniform_damping->at_rest();
    result.passing = at_rest;
    for (const DampingFilter& filter : system.uniform_damping->filters) {
      const double c = filter.rate * time_step / 2;
      const double weight = at_rest * filter.weight;
      result.passing += weight / (1 + c);
      result.filters.at(result.count++) = {weight, (1 - c) / (1 + c), 2 * c / ((1 + c) * (1 + c))};
    }
    if (damped_about_rest(system)) result.filters.at(result.count++) = {-1, 1, 0};
  }
  return result;
}

void start_filters(const LinearSystem& system, double time_step, StructureState& state) {
  if (!system.uniform_damping) return;
  std::vector<double> force(state.displacement.size());
  stiffness::StoredForces store(force.data());
  system.stiffness->apply({state.displacement.data(), state.displacement.data(), 0}, store);
  const Filters<double> filters = filters_of(system, time_step);
  for (std::size_t k = 0; k < system.uniform_damping->filters.size(); ++k) {
    const double share = 1 - filters.filters[k].newest();  // Z = W - t Q of W = Q
    for (std::size_t i = 0; i < force.size(); ++i) state.filtered[k][i] = share * force[i];
  }
  const double kept = 1 - system.uniform_damping->at_rest();
  const std::vector<double> held = rest_forces(system);
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double yielded = system.rest_law_force.empty() ? 0 : system.rest_law_force[i];
    state.filtered.back()[i] = kept * (held[i] + yielded);
  }
}

StructureStep::StructureStep(const LinearSystem& system, StructureState& state, double time_step)
    : system_(system),
      state_(state),
      filters_(filters_of(system, time_step)),
      forces_(system.lumped_mass.size()),
      vectors_(std::make_unique<VectorParts>()) {
  terms_.time_step = time_step;
  if (system.supports || system.loads) known_step_.assign(system.lumped_mass.size(), 0.0);
  find_segments(dofs_of_extra_damping(system));
  if (system.coupled_mass) coupled_ = std::make_unique<CoupledStep>(system, state, filters_);
}

StructureStep::StructureStep(StructureStep&& other) noexcept = default;
StructureStep::~StructureStep() = default;

double StructureStep::ground_step_at(std::size_t dof) const {
  const double known = known_step_.empty() ? 0 : known_step_[dof];
  if (system_.generalised) {
    double step = known;
    for (std::size_t d = 0; d < 3; ++d) {
      add_product(ground_step_[d], system_.generalised->influence[d][dof], step);
    }
    return step;
  }
  const int direction = system_.direction[dof];
  const double ground = direction < 0 ? 0 : ground_step_[direction];
  return known_step_.empty() ? ground : ground + known;
}

double StructureStep::load_power() const {
  double power = 0;
  for (std::size_t l = 0; system_.loads && l < system_.loads->loads.size(); ++l) {
    const LoadShape& shape = system_.loads->loads[l];
    const double value = load_values_[shape.load];
    if (value == 0) continue;
    double product = 0;
    for (std::size_t k = 0; k < shape.dofs.size(); ++k) {
      product += shape.force[k] * state_.velocity[shape.dofs[k]];
    }
    power += value * product;
  }
  return power;
}

void StructureStep::add_momentum(std::size_t dof, double momentum) {
  if (!known_step_.empty()) sums_.support_input -= known_step_[dof] * momentum / 2;
  if (system_.generalised) {
    for (std::size_t d = 0; d < 3; ++d) {
      sums_.momentum[d] += system_.generalised->influence[d][dof] * momentum;
    }
  } else if (system_.direction[dof] >= 0) {
    sums_.momentum[system_.direction[dof]] += momentum;
  }
}

bool StructureStep::is_inelastic(std::size_t dof, std::size_t count) const {
  if (system_.inelastic.empty()) return false;
  const auto first = system_.inelastic.begin() + static_cast<std::ptrdiff_t>(dof);
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(count),
                     [](char any) { return any != 0; });
}

StructureStep::Order StructureStep::order_at(std::size_t dof,
                                             const std::vector<char>& acted_on) const {
  const auto acts = [&](std::size_t from, std::size_t count) {
    return std::any_of(acted_on.begin() + static_cast<std::ptrdiff_t>(from),
                       acted_on.begin() + static_cast<std::ptrdiff_t>(from + count),
                       [](char any) { return any != 0; });
  };
  if (system_.coupled_mass && system_.coupled_mass->node_of(static_cast<LocalIndex>(dof)) >= 0) {
    return Order::coupled;
  }
  if (acts(dof, 1)) return Order::none;
  if (system_.generalised) return Order::generalised;
  if (!directions_are(system_, dof, {0, 1, 2}) || acts(dof, 3)) return Order::none;
  if (directions_are(system_, dof + 3, {-1, -1, -1})) {
    return acts(dof, 6) ? Order::none : Order::nodes_of_six;
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

void StructureStep::find_segments(const std::vector<char>& acted_on) {
  const std::size_t dofs = system_.lumped_mass.size();
  std::size_t coupled = 0;
  for (std::size_t dof = 0; dof < dofs;) {
    const Order order = order_at(dof, acted_on);
    const std::size_t length = length_at(dof, order);
    const bool yields = is_inelastic(dof, length);
    if (segments_.empty() || segments_.back().order != order || segments_.back().yields != yields) {
      const auto begin = static_cast<LocalIndex>(dof);
      segments_.push_back({begin, begin, order, yields, node_mass_.size(), coupled});
    }
    if (order == Order::translations) {
      node_mass_.push_back(system_.lumped_mass[dof]);
      node_inverse_mass_.push_back(system_.inverse_mass[dof]);
    }
    coupled += order == Order::coupled ? length : 0;
    dof += length;
    segments_.back().end = static_cast<LocalIndex>(dof);
  }
  node_mass_.resize(node_mass_.size() + most_lanes, 0.0);  // whole vectors are read
  node_inverse_mass_.resize(node_mass_.size(), 0.0);
}

void StructureStep::watch(std::span<const LocalIndex> dofs, bool always) {
  forces_.watch(dofs);
  const bool needed = system_.damping.beta != 0 || system_.uniform_damping;
  always_keeps_ = always_keeps_ || (always && needed);
}

void StructureStep::begin(double duration, const std::array<double, 3>& ground_acceleration,
                          const StepRequest& request, std::span<const double> supports,
                          std::span<const double> loads) {
  terms_ = {terms_.time_step, duration, 1 - duration * system_.damping.alpha, system_.damping.beta};
  stiffness_velocity_ = request.stiffness_velocity;
  keeps_ = (request.forces || always_keeps_) && !forces_.none();
  for (std::size_t d = 0; d < 3; ++d) {
    ground_step_[d] = duration * (ground_acceleration[d] - system_.gravity[d]);
  }
  *vectors_ = {};
  for (std::size_t l = 0; l < pattern; ++l) {
    vectors_->ground[0][l / lanes][l % lanes] = ground_step_[l % 3];
    vectors_->ground[1][l / lanes][l % lanes] = l % 6 < 3 ? ground_step_[l % 3] : 0;
  }
  std::fill(known_step_.begin(), known_step_.end(), 0.0);
  for (std::size_t c = 0; system_.supports && c < supports.size(); ++c) {
    const std::vector<double>& shape = system_.supports->shape[c];
    const double step = duration * supports[c];
    for (std::size_t i = 0; i < shape.size(); ++i) known_step_[i] += step * shape[i];
  }
  load_values_ = loads;
  for (std::size_t l = 0; system_.loads && l < system_.loads->loads.size(); ++l) {
    const LoadShape& shape = system_.loads->loads[l];
    const double step = duration * load_values_[shape.load];
    for (std::size_t k = 0; k < shape.dofs.size(); ++k) {
      const auto i = static_cast<std::size_t>(shape.dofs[k]);
      known_step_[i] -= step * shape.force[k] * system_.inverse_mass[i];
    }
  }
  dof_sums_ = {};
  dof_energies_ = {};
  sums_ = {};
  sums_.load = load_power();
}

void StructureStep::receive(LocalIndex begin, LocalIndex end, const double* force) {
  if (keeps_) {
    forces_.take(begin, end, force, state_.inelastic_force, filters_, state_.filtered);
  }
  auto segment = std::upper_bound(segments_.begin(), segments_.end(), begin,
                                  [](LocalIndex dof, const Segment& s) { return dof < s.end; });
  for (LocalIndex dof = begin; dof < end; ++segment) {
    const LocalIndex stop = std::min(end, segment->end);
    const double* const from = force + (dof - begin);
    advance(*segment, dof, stop, from);
    dof = stop;
  }
}

void StructureStep::add_energies_before(std::size_t first, std::size_t end, const double* force) {
  const StepTerms<WideLanes> terms = in_lanes<WideLanes>(terms_);
  const auto add_vector = [&](std::size_t i, const double* from, auto count) {
    WideLanes q, mass, rate;
    DofState<WideLanes> dof;
    load_first(from, count, q);
    load_first(&system_.lumped_mass[i], count, mass);
    load_first(stiffness_velocity_ + i, count, rate);
    load_first(&state_.displacement[i], count, dof.displacement);
    load_first(&state_.velocity[i], count, dof.velocity);
    add_energies(terms, mass, q, rate, dof, vectors_->energies);
  };
  std::size_t i = first;
  for (; i + lanes <= end; i += lanes, force += lanes) add_vector(i, force, AllLanes());
  if (i < end) add_vector(i, force, end - i);
}

template <typename Others, typename Masses, typename Ground>
void StructureStep::advance_vectors(std::size_t first, std::size_t end, const double* force,
                                    Others& others, Masses masses, Ground& ground) {
  double* const displacement = state_.displacement.data();
  double* const velocity = state_.velocity.data();
  const StepTerms<WideLanes> terms = in_lanes<WideLanes>(terms_);
  DofSums<WideLanes> sums = vectors_->sums;
  const auto advance_vector = [&]<int k>(std::size_t i, const double* from, auto count)
      __attribute__((always_inline)) {
    WideLanes q, mass, inverse_mass;
    DofState<WideLanes> dof;
    load_first(from, count, q);
    load_first(displacement + i, count, dof.displacement);
    load_first(velocity + i, count, dof.velocity);
    masses.template at<k>(count, mass, inverse_mass);
    const WideLanes before = dof.velocity;
    const WideLanes resisting = others.resisting(i, count, q);
    const WideLanes f = others.filtered(i, count, resisting);
    WideLanes step = ground.template step<k>(i, count);
    others.add_known_step(i, count, step);
    const WideLanes free = free_velocity(terms, before, f, inverse_mass, step);
    others.add_filtered_work(f, resisting, free + before);
    const WideLanes momentum = settle(terms, q, free, mass, dof, sums);
    others.add_known_work(i, count, momentum);
    ground.template add<k>(i, count, momentum);
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
  vectors_->sums = sums;
}

void StructureStep::advance_dofs(std::size_t first, std::size_t end, const double* force) {
  for (std::size_t i = first; i < end; ++i, ++force) {
    DofState<double> dof{state_.displacement[i], state_.velocity[i]};
    const double mass = system_.lumped_mass[i];
    const double before = dof.velocity;
    if (stiffness_velocity_ != nullptr) {
      add_energies(terms_, mass, *force, stiffness_velocity_[i], dof, dof_energies_);
    }
    const double q = state_.inelastic_force.empty() ? *force : *force + state_.inelastic_force[i];
    double f = q;
    if (system_.uniform_damping) {
      f *= filters_.passing;
      for (std::size_t k = 0; k < filters_.count; ++k) {
        pass_filter(filters_.filters[k], q, state_.filtered[k][i], f);
      }
    }
    double after = free_velocity(terms_, before, f, system_.inverse_mass[i], ground_step_at(i));
    if (!state_.extra_force.empty()) {
      subtract_product(terms_.duration, system_.inverse_mass[i] * state_.extra_force[i], after);
      sums_.device += state_.extra_force[i] * (after + before);
    }
    dof_sums_.filtered += (f - q) * (after + before);
    add_momentum(i, settle(terms_, *force, after, mass, dof, dof_sums_));
    state_.displacement[i] = dof.displacement;
    state_.velocity[i] = dof.velocity;
  }
}

void StructureStep::advance(const Segment& segment, LocalIndex begin, LocalIndex end,
                            const double* force) {
  const auto offset = static_cast<std::size_t>(begin - segment.begin);
  if (segment.order == Order::coupled) {
    coupled_->keep(segment.first_coupled + offset, static_cast<std::size_t>(end - begin), force);
    return;
  }
  if (segment.order == Order::none) {
    advance_dofs(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), force);
    return;
  }
  if (stiffness_velocity_ != nullptr) {
    add_energies_before(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), force);
  }
  if (segment.yields || system_.uniform_damping || !known_step_.empty()) {
    OtherActions others({segment.yields ? state_.inelastic_force.data() : nullptr,
                         system_.uniform_damping ? &filters_ : nullptr, &state_.filtered,
                         known_step_.empty() ? nullptr : known_step_.data(),
                         &vectors_->filtered_work, &vectors_->known_work});
    advance_in_order(segment, begin, end, force, others);
  } else {
    NothingElse others;
    advance_in_order(segment, begin, end, force, others);
  }
}

template <typename Others>
void StructureStep::advance_in_order(const Segment& segment, LocalIndex begin, LocalIndex end,
                                     const double* force, Others& others) {
  const std::size_t first = begin;
  const std::size_t stop = end;
  const DofMasses dof_masses(&system_.lumped_mass[first], &system_.inverse_mass[first]);
  if (segment.order == Order::translations) {
    const std::size_t node =
        segment.first_node + (first - static_cast<std::size_t>(segment.begin)) / 3;
    PatternGround ground(vectors_->ground[0], vectors_->momentum[0]);
    advance_vectors(first, stop, force, others,
                    NodeMasses(&node_mass_[node], &node_inverse_mass_[node]), ground);
  } else if (segment.order == Order::nodes_of_six) {
    PatternGround ground(vectors_->ground[1], vectors_->momentum[1]);
    advance_vectors(first, stop, force, others, dof_masses, ground);
  } else {
    InfluenceGround ground(*system_.generalised, ground_step_, vectors_->influenced_momentum);
    advance_vectors(first, stop, force, others, dof_masses, ground);
  }
}

void StructureStep::complete() {
  if (coupled_) {
    coupled_->advance(terms_, ground_step_, known_step_, stiffness_velocity_, dof_sums_,
                      dof_energies_, sums_);
  }
}

void StructureStep::act(std::span<const LocalIndex> dofs, std::span<const double> force,
                        bool from_rest) {
  // The filter that holds the force at rest has it from the start.
  const std::size_t filters =
      from_rest && system_.uniform_damping ? system_.uniform_damping->filters.size() : 0;
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    state_.inelastic_force[i] = force[k];
    for (std::size_t f = 0; f < filters; ++f) {
      state_.filtered[f][i] += (1 - filters_.filters[f].newest()) * force[k];
    }
  }
}

void StructureStep::remember(std::span<const LocalIndex> dofs, interactions::Before& before) const {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    before.displacement[k] = state_.displacement[i];
    before.velocity[k] = state_.velocity[i];
  }
}

void StructureStep::correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
                            std::span<const double> velocity) {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    const DofState<double> old{before.displacement[k], before.velocity[k]};
    DofState<double> dof{state_.displacement[i], state_.velocity[i]};
    const DofForces forces = keeps_ ? forces_.at(dofs[k]) : DofForces{};
    if (!state_.extra_force.empty()) {
      sums_.device += state_.extra_force[i] * (velocity[k] - dof.velocity);
    }
    add_momentum(
        i, correct_dof(terms_, system_.lumped_mass[i], old, velocity[k], forces, dof, dof_sums_));
    state_.velocity[i] = dof.velocity;
    state_.displacement[i] = dof.displacement;
  }
}

StepSums StructureStep::sums() const {
  StepSums total = sums_;
  add_to(dof_sums_, total);
  add_to(vectors_->sums, total);
  total.filtered += add_up(vectors_->filtered_work);
  add_to(dof_energies_, total);
  add_to(vectors_->energies, total);
  for (std::size_t l = 0; l < pattern; ++l) {
    total.momentum[l % 3] += vectors_->momentum[0][l / lanes][l % lanes];
    if (l % 6 < 3) total.momentum[l % 3] += vectors_->momentum[1][l / lanes][l % lanes];
  }
  for (std::size_t d = 0; d < 3; ++d) total.momentum[d] += add_up(vectors_->influenced_momentum[d]);
  total.support_input -= add_up(vectors_->known_work) / 2;
  total.load += load_power();
  return total;
}

}  // namespace pounding
