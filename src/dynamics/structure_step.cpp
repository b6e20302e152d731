#include "dynamics/structure_step.h"

#include <algorithm>
#include <cstddef>

#include "common/wide_lanes.h"
#include "dynamics/step_body.h"
#include "system/load_shapes.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

constexpr std::size_t lanes = wide_lane_count;

bool directions_are(const LinearSystem& system, std::size_t dof, std::array<int, 3> expected) {
  if (dof + 3 > system.direction.size()) return false;
  for (std::size_t d = 0; d < 3; ++d) {
    if (system.direction[dof + d] != expected[d]) return false;
  }
  return true;
}

}  // namespace

template <typename Number>
struct StructureStep<Number>::VectorParts {
  static constexpr std::size_t count = 3;  ///< vectors of a pattern

  StepTotals<WideLanes> totals;
  /// Patterns of nodes without and with rotations: h (a_g - g) iota, and the sums of M s.
  WideLanes ground[2][count]{};
  WideLanes momentum[2][count]{};
};

template <typename Number>
StructureStep<Number>::StructureStep(std::span<const LinearSystem* const> systems,
                                     StateOf<Number>& state, double time_step, bool wait)
    : system_(*systems.front()),
      runs_(systems.size()),
      state_(state),
      dofs_(system_.lumped_mass.size()),
      alpha_(number_of<Number>(systems, [](const auto& s) { return s.damping.alpha; })),
      beta_(number_of<Number>(systems, [](const auto& s) { return s.damping.beta; })),
      forces_(dofs_),
      vectors_(std::make_unique<VectorParts>()) {
  if (!shares_masses()) {
    mass_ = constants_of<Number>(systems, &LinearSystem::lumped_mass);
    inverse_mass_ = constants_of<Number>(systems, &LinearSystem::inverse_mass);
  }
  terms_.time_step = Number{} + time_step;
  filters_.passing = Number{} + 1.0;
  for (std::size_t member = 0; member < systems.size(); ++member) {
    const LinearSystem& system = *systems[member];
    put_filters(filters_of(system, time_step), member, filters_);
    filters_forces_ = filters_forces_ || system.uniform_damping;
    corrections_need_forces_ =
        corrections_need_forces_ || system.uniform_damping || system.damping.beta != 0;
  }
  for (std::size_t d = 0; d < 3; ++d) {
    gravity_[d] = number_of<Number>(systems, [d](const auto& s) { return s.gravity[d]; });
    if (!system_.generalised) continue;
    influence_[d] = constants_of<Number>(
        systems, [d](const auto& s) -> const auto& { return s.generalised->influence[d]; });
  }
  for (std::size_t c = 0; system_.supports && c < system_.supports->shape.size(); ++c) {
    supports_.push_back(constants_of<Number>(
        systems, [c](const auto& s) -> const auto& { return s.supports->shape[c]; }));
  }
  for (std::size_t l = 0; system_.loads && l < system_.loads->loads.size(); ++l) {
    const LoadShape& shape = system_.loads->loads[l];
    const auto force = [l](const auto& s) -> const auto& {
      return s.loads->loads[l].force;
    };
    loads_.push_back({shape.load, shape.dofs, constants_of<Number>(systems, force)});
  }
  for (std::size_t d = 0; !system_.water.dofs.empty() && d < 3; ++d) {
    const auto force = [d](const auto& s) -> const auto& {
      return s.water.force[d];
    };
    water_loads_.push_back({d, system_.water.dofs, constants_of<Number>(systems, force)});
  }
  if (system_.supports || !loads_.empty() || !water_loads_.empty()) {
    known_step_.assign(dofs_, Number{});
  }
  find_segments(wait);
}

template <typename Number>
StructureStep<Number>::StructureStep(StructureStep&& other) noexcept = default;
template <typename Number>
StructureStep<Number>::~StructureStep() = default;

template <typename Number>
Number StructureStep<Number>::load_power() const {
  Number power{};
  for (const auto& [number, dofs, force] : loads_) {
    if (load_values_[number] == 0) continue;
    Number product{};
    for (std::size_t k = 0; k < dofs.size(); ++k) product += force[k] * state_.velocity[dofs[k]];
    power += (Number{} + load_values_[number]) * product;
  }
  return power;
}

template <typename Number>
std::array<double, 3> StructureStep<Number>::water_momentum() const {
  std::array<double, 3> momentum{};
  const auto& [dofs, force] = system_.water;
  for (std::size_t k = 0; k < 3 * dofs.size(); ++k) {
    momentum[k % 3] += force[k % 3][k / 3] * of_member(state_.velocity[dofs[k / 3]], 0);
  }
  return momentum;
}

template <typename Number>
typename StructureStep<Number>::Segment StructureStep<Number>::segment_at(LocalIndex dof,
                                                                          bool wait) const {
  const auto first = static_cast<std::size_t>(dof);
  std::size_t length = 1;
  Segment segment{dof, dof, Order::directions, false, wait, node_mass_.size()};
  if (system_.generalised) {
    segment.order = Order::generalised;
  } else if (std::is_same_v<Number, double> && directions_are(system_, first, {0, 1, 2})) {
    const double* const mass = &system_.lumped_mass[first];
    if (directions_are(system_, first + 3, {-1, -1, -1})) {
      segment.order = Order::nodes_of_six;
      length = 6;
    } else if (mass[0] == mass[1] && mass[1] == mass[2]) {
      segment.order = Order::translations;
      length = 3;
    }
  }
  if (system_.coupled_mass) segment.waits = wait || system_.coupled_mass->node_of(dof) >= 0;
  for (std::size_t i = first; i < first + length && !system_.inelastic.empty(); ++i) {
    segment.yields = segment.yields || system_.inelastic[i] != 0;
  }
  segment.end = static_cast<LocalIndex>(first + length);
  return segment;
}

template <typename Number>
void StructureStep<Number>::find_segments(bool wait) {
  const auto dofs = static_cast<LocalIndex>(dofs_);
  for (LocalIndex dof = 0; dof < dofs; dof = segments_.back().end) {
    const Segment next = segment_at(dof, wait);
    if (segments_.empty() || !segments_.back().goes_on(next)) {
      segments_.push_back(next);
    } else {
      segments_.back().end = next.end;
    }
    if (next.order == Order::translations) {
      node_mass_.push_back(system_.lumped_mass[dof]);
      node_inverse_mass_.push_back(system_.inverse_mass[dof]);
    }
  }
  node_mass_.resize(node_mass_.size() + most_lanes, 0.0);  // whole vectors are read
  node_inverse_mass_.resize(node_mass_.size(), 0.0);
  if (std::ranges::none_of(segments_, &Segment::waits)) return;
  const std::vector<Number> zeros(dofs_, Number{});
  waiting_ = {zeros, zeros, zeros};
  if (system_.coupled_mass) field_.resize(system_.coupled_mass->field_size());
}

template <typename Number>
void StructureStep<Number>::watch(std::span<const LocalIndex> dofs, bool always) {
  forces_.watch(dofs);
  always_keeps_ = always_keeps_ || (always && corrections_need_forces_);
}

template <typename Number>
void StructureStep<Number>::begin(double duration, const std::array<Number, 3>& ground_acceleration,
                                  const StepRequest<Number>& request,
                                  std::span<const Number> supports, std::span<const double> loads) {
  const Number h = Number{} + duration;
  terms_ = {terms_.time_step, h, Number{} + 1.0 - h * alpha_, beta_, h * alpha_};
  stiffness_velocity_ = request.stiffness_velocity;
  keeps_ = (request.forces || always_keeps_) && !forces_.none();
  totals_ = {};
  *vectors_ = {};
  for (std::size_t d = 0; d < 3; ++d) {
    ground_step_[d] = h * (ground_acceleration[d] - gravity_[d]);
    shaken_[d] = false;
    for (std::size_t member = 0; member < runs_; ++member) {
      shaken_[d] = shaken_[d] || of_member(ground_step_[d], member) != 0;
    }
  }
  if constexpr (std::is_same_v<Number, double>) {
    for (std::size_t l = 0; l < step_pattern; ++l) {
      vectors_->ground[0][l / lanes][l % lanes] = ground_step_[l % 3];
      vectors_->ground[1][l / lanes][l % lanes] = l % 6 < 3 ? ground_step_[l % 3] : 0;
    }
  }
  std::fill(known_step_.begin(), known_step_.end(), Number{});
  for (std::size_t c = 0; c < supports_.size() && c < supports.size(); ++c) {
    const Number step = h * supports[c];
    for (std::size_t i = 0; i < supports_[c].size(); ++i) known_step_[i] += step * supports_[c][i];
  }
  load_values_ = loads;
  for (const Load& load : loads_) add_known(load, h * (Number{} + load_values_[load.number]));
  for (const Load& load : water_loads_) add_known(load, -ground_step_[load.number]);
  load_before_ = load_power();
  water_before_ = water_momentum();
  added_kinetic_before_ = 0;
}

template <typename Number>
void StructureStep<Number>::receive(LocalIndex begin, LocalIndex end, const Number* force) {
  if (keeps_) {
    forces_.take(begin, end, force, state_.inelastic_force, filters_, state_.filtered);
  }
  auto segment = std::upper_bound(segments_.begin(), segments_.end(), begin,
                                  [](LocalIndex dof, const Segment& s) { return dof < s.end; });
  for (LocalIndex dof = begin; dof < end; ++segment) {
    const LocalIndex stop = std::min(end, segment->end);
    advance(*segment, dof, stop, force + (dof - begin), false);
    dof = stop;
  }
}

template <typename Number>
void StructureStep<Number>::advance(const Segment& segment, LocalIndex begin, LocalIndex end,
                                    const Number* force, bool settles) {
  const ActionParts<Number> parts{
      .inelastic_force = segment.yields ? state_.inelastic_force.data() : nullptr,
      .extra_force = state_.extra_force.empty() ? nullptr : state_.extra_force.data(),
      .known_step = known_step_.empty() ? nullptr : known_step_.data(),
      .stiffness_velocity = stiffness_velocity_,
      .filters = filters_forces_ ? &filters_ : nullptr,
      .memories = &state_.filtered,
      .waiting = segment.waits ? &waiting_ : nullptr,
      .settles = settles};
  if (parts.any()) {
    advance_in_order<true>(segment, begin, end, force, parts);
  } else {
    advance_in_order<false>(segment, begin, end, force, parts);
  }
}

template <typename Number>
template <bool any>
void StructureStep<Number>::advance_in_order(const Segment& segment, LocalIndex begin,
                                             LocalIndex end, const Number* force,
                                             const ActionParts<Number>& parts) {
  constexpr bool vectors = std::is_same_v<Number, double>;
  using Value = std::conditional_t<vectors, WideLanes, Number>;
  const std::size_t first = begin;
  const std::size_t stop = end;
  const DofMasses<Number> masses{mass_.data(), inverse_mass_.data()};
  if (segment.order == Order::directions) {
    const Actions<Number, Number, any> others(parts);
    DirectionGround<Number> ground{system_.direction.data(), ground_step_, totals_.momentum};
    if constexpr (!vectors) {
      const DofMasses<double> of_all{system_.lumped_mass.data(), system_.inverse_mass.data()};
      return advance_values(state_, terms_, first, stop, force, others, of_all, ground, totals_);
    }
    return advance_values(state_, terms_, first, stop, force, others, masses, ground, totals_);
  }
  const Actions<Value, Number, any> others(parts);
  if (segment.order == Order::generalised) {
    StepTotals<Value>& totals = [this]() -> auto& {
      if constexpr (vectors) return vectors_->totals;
      if constexpr (!vectors) return totals_;
    }
    ();
    InfluenceGround<Value, Number> ground(influence_, ground_step_, shaken_, totals.momentum);
    return advance_values(state_, terms_, first, stop, force, others, masses, ground, totals);
  }
  if constexpr (vectors) {
    const bool turns = segment.order == Order::nodes_of_six;
    PatternGround ground(vectors_->ground[turns], vectors_->momentum[turns]);
    if (turns) {
      advance_values(state_, terms_, first, stop, force, others, masses, ground, vectors_->totals);
    } else {
      const std::size_t node =
          segment.first_node + (first - static_cast<std::size_t>(segment.begin)) / 3;
      const NodeMasses of_nodes(&node_mass_[node], &node_inverse_mass_[node]);
      advance_values(state_, terms_, first, stop, force, others, of_nodes, ground,
                     vectors_->totals);
    }
  }
}

template <typename Number>
void StructureStep<Number>::complete() {
  if (waiting_.velocity.empty()) return;
  if constexpr (std::is_same_v<Number, double>) {
    const CoupledMass& mass = *system_.coupled_mass;
    if (stiffness_velocity_ != nullptr) {
      added_kinetic_before_ = mass.added_product(state_.velocity.data());
    }
    mass.take(waiting_.velocity.data(), field_.data());
    mass.solve(field_.data());
    for (std::size_t n = 0; n < mass.nodes().size(); ++n) {
      const std::size_t begin = mass.nodes()[n].begin, count = mass.nodes()[n].count;
      const double* const change = &field_[mass.offset(n)];
      for (std::size_t c = 0; c < count; ++c) {
        waiting_.velocity[begin + c] = state_.velocity[begin + c] + change[c];
      }
    }
  }
  for (const Segment& segment : segments_) {
    if (!segment.waits) continue;
    advance(segment, segment.begin, segment.end, &waiting_.stiffness[segment.begin], true);
  }
}

template <typename Number>
void StructureStep<Number>::act(std::size_t member, std::span<const LocalIndex> dofs,
                                std::span<const double> force, bool from_rest) {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    set_member(state_.inelastic_force[i], member, force[k]);
    for (std::size_t f = 0; from_rest && f < filters_.count; ++f) {
      // The filter that holds the force at rest, which takes nothing, has it from the start.
      const auto& filter = filters_.filters[f];
      if (of_member(filter.take, member) == 0) continue;
      Number& memory = state_.filtered[f][i];
      const double newest = (1 - of_member(filter.keep, member)) / 2;
      set_member(memory, member, of_member(memory, member) + (1 - newest) * force[k]);
    }
  }
}

template <typename Number>
void StructureStep<Number>::remember(std::size_t member, std::span<const LocalIndex> dofs,
                                     interactions::Before& before) const {
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    before.displacement[k] = of_member(state_.displacement[i], member);
    before.velocity[k] = of_member(state_.velocity[i], member);
  }
}

template <typename Number>
void StructureStep<Number>::correct(std::size_t member, std::span<const LocalIndex> dofs,
                                    const interactions::Before& before,
                                    std::span<const double> velocity) {
  const StepTerms<double> terms{of_member(terms_.time_step, member),
                                of_member(terms_.duration, member), of_member(terms_.decay, member),
                                of_member(terms_.beta, member), of_member(terms_.drag, member)};
  StepTotals<double> change;
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    const DofState<double> old{before.displacement[k], before.velocity[k]};
    DofState<double> dof{of_member(state_.displacement[i], member),
                         of_member(state_.velocity[i], member)};
    DofForces<double> forces;
    if (keeps_) {
      const DofForces<Number>& kept = forces_.at(dofs[k]);
      forces = {of_member(kept.stiffness, member), of_member(kept.acting, member)};
    }
    if (!state_.extra_force.empty()) {
      change.dofs.device += of_member(state_.extra_force[i], member) * (velocity[k] - dof.velocity);
    }
    const double mass = shares_masses() ? system_.lumped_mass[i] : of_member(mass_[i], member);
    const double gained = correct_dof(terms, mass, old, velocity[k], forces, dof, change.dofs);
    if (!known_step_.empty()) change.dofs.known_work += of_member(known_step_[i], member) * gained;
    if (system_.generalised) {
      for (std::size_t d = 0; d < 3; ++d) {
        change.momentum[d] += of_member(influence_[d][i], member) * gained;
      }
    } else if (system_.direction[i] >= 0) {
      change.momentum[system_.direction[i]] += gained;
    }
    set_member(state_.velocity[i], member, dof.velocity);
    set_member(state_.displacement[i], member, dof.displacement);
  }
  add_to_member(change, member, totals_);
}

template <typename Number>
StepSums StructureStep<Number>::sums(std::size_t member) const {
  StepSums total;
  add_to(
      totals_, [member](const Number& value) { return of_member(value, member); }, total);
  if constexpr (std::is_same_v<Number, double>) {
    add_to(
        vectors_->totals, [](const WideLanes& value) { return add_up(value); }, total);
    for (std::size_t l = 0; l < step_pattern; ++l) {
      total.momentum[l % 3] += vectors_->momentum[0][l / lanes][l % lanes];
      if (l % 6 < 3) total.momentum[l % 3] += vectors_->momentum[1][l / lanes][l % lanes];
    }
  }
  total.added_kinetic_before = added_kinetic_before_;
  total.load = of_member(load_before_ + load_power(), member);
  total.water_momentum = water_momentum();
  for (std::size_t d = 0; d < 3; ++d) total.water_momentum[d] += water_before_[d];
  return total;
}

template class StructureStep<double>;
template class StructureStep<BatchValue>;

}  // namespace pounding
