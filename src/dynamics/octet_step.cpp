#include "dynamics/octet_step.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "common/row_products.h"
#include "dynamics/structure_step.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

/// The filters of one run in lane `lane`; those that it lacks let everything pass.
void put_filters(const Filters<double>& from, std::size_t lane, Filters<Octet>& to) {
  to.count = std::max(to.count, from.count);
  to.passing.set(lane, from.passing);
  for (std::size_t i = 0; i < from.count; ++i) {
    to.filters[i].weight.set(lane, from.filters[i].weight);
    to.filters[i].keep.set(lane, from.filters[i].keep);
    to.filters[i].take.set(lane, from.filters[i].take);
  }
}

/// The filters of one run out of those of all.
Filters<double> take_filters(const Filters<Octet>& from, std::size_t lane) {
  Filters<double> to{from.count, from.passing[lane], {}};
  for (std::size_t i = 0; i < from.count; ++i) {
    const auto& [weight, keep, take] = from.filters[i];
    to.filters[i] = {weight[lane], keep[lane], take[lane]};
  }
  return to;
}

StepTerms<double> take_terms(const StepTerms<Octet>& from, std::size_t lane) {
  return {from.time_step[lane], from.duration[lane], from.decay[lane], from.beta[lane]};
}

/// Diagonal of a matrix that is nothing else.
std::vector<double> diagonal_of(const LinearSystem& system, const stiffness::Stiffness& matrix) {
  std::vector<double> diagonal(system.lumped_mass.size());
  const VecHandle vector = wrap_vector(system, diagonal);
  POUNDING_PETSC(MatGetDiagonal(matrix.matrix(), vector.get()));
  return diagonal;
}

}  // namespace

OctetStep::OctetStep(std::span<const LinearSystem* const> systems, const LinearSystem& scene,
                     double time_step)
    : time_step_(time_step) {
  filters_.passing = all_octet(1);
  for (auto& [weight, keep, take] : filters_.filters) weight = keep = take = Octet{};
  for (std::size_t lane = 0; lane < systems.size(); ++lane) {
    take_system(*systems[lane], time_step, lane);
  }
  take_dashpots(systems, scene);
  const std::vector<Octet> zero(coordinates(), Octet{});
  state_ = {zero, zero, std::vector<std::vector<Octet>>(filters_.count, zero)};
}

void OctetStep::take_system(const LinearSystem& system, double time_step, std::size_t lane) {
  const std::size_t size = system.lumped_mass.size();
  const auto put = [&](std::span<const double> values, std::vector<Octet>& to) {
    to.resize(size, Octet{});
    for (std::size_t i = 0; i < size; ++i) to[i].set(lane, values[i]);
  };
  put(system.lumped_mass, mass_);
  put(system.inverse_mass, inverse_mass_);
  put(diagonal_of(system, *system.stiffness), stiffness_);
  if (system.extra_damping) put(diagonal_of(system, *system.extra_damping), extra_damping_);
  for (std::size_t d = 0; d < 3; ++d) {
    put(system.generalised->influence[d], influence_[d]);
    gravity_[d].set(lane, system.gravity[d]);
  }
  alpha_.set(lane, system.damping.alpha);
  beta_.set(lane, system.damping.beta);
  put_filters(filters_of(system, time_step), lane, filters_);
  if (system.loads) take_loads(system, lane);
}

void OctetStep::take_loads(const LinearSystem& system, std::size_t lane) {
  const std::vector<LoadShape>& shapes = system.loads->loads;
  loads_.resize(shapes.size());
  for (std::size_t l = 0; l < shapes.size(); ++l) {
    loads_[l].number = shapes[l].load;
    loads_[l].shape.resize(coordinates(), Octet{});
    for (std::size_t k = 0; k < shapes[l].dofs.size(); ++k) {
      const auto i = static_cast<std::size_t>(shapes[l].dofs[k]);
      loads_[l].shape[i].set(lane, shapes[l].force[k] * system.inverse_mass[i]);
    }
  }
}

void OctetStep::take_dashpots(std::span<const LinearSystem* const> systems,
                              const LinearSystem& scene) {
  const auto dashpots = interactions::dashpot_rows(scene);
  if (!dashpots) return;
  for (std::size_t lane = 0; lane < systems.size(); ++lane) {
    const LinearSystem& own = *systems[lane];
    braked_[lane] = own.inverse_mass == scene.inverse_mass &&
                    own.lumped_mass == scene.lumped_mass &&
                    interactions::dashpot_rows(own) == dashpots;
  }
  if (std::ranges::none_of(braked_, std::identity())) return;
  std::fill(braked_.begin() + systems.size(), braked_.end(), true);  // nothing moves in these
  dashpots_.emplace(interactions::DashpotModes(scene, *dashpots, time_step_));
  free_.resize(coordinates());
  velocity_.resize(coordinates());
}

void OctetStep::brake() {
  for (std::size_t i = 0; i < coordinates(); ++i) velocity_[i] = free_[i].velocity;
  dashpots_->brake(terms_.duration[0] / time_step_, state_.velocity, velocity_);
  dashpot_loss_ = dashpots_->loss(state_.velocity, velocity_);
  for (std::size_t lane = 0; lane < octet_size; ++lane) {
    if (braked_[lane]) continue;
    dashpot_loss_.set(lane, 0);
    for (std::size_t i = 0; i < coordinates(); ++i) {
      velocity_[i].set(lane, free_[i].velocity[lane]);
    }
  }
}

void OctetStep::step(double duration, const std::array<Octet, 3>& ground_acceleration,
                     std::span<const double> loads, bool with_energies) {
  ++steps_;
  const Octet h = all_octet(duration);
  terms_ = {all_octet(time_step_), h, all_octet(1) - h * alpha_, beta_};
  for (std::size_t d = 0; d < 3; ++d) {
    ground_step_[d] = h * (ground_acceleration[d] - gravity_[d]);
    shaken_[d] = false;
    for (std::size_t lane = 0; lane < octet_size; ++lane) {
      shaken_[d] = shaken_[d] || ground_step_[d][lane] != 0;
    }
    momentum_[d] = Octet{};
  }
  for (Load& load : loads_) {
    load.value = loads[load.number];
    load.step = all_octet(-duration * load.value);
    load.gained = Octet{};
  }
  sums_ = DofSums<Octet>{};
  energies_ = DofEnergies<Octet>{};
  extra_before_ = device_ = Octet{};
  corrected_.fill(false);
  if (filters_.count > 0) {
    with_energies ? advance<true, true>() : advance<false, true>();
  } else {
    with_energies ? advance<true, false>() : advance<false, false>();
  }
}

template <bool with_energies, bool filtered>
void OctetStep::advance() {
  DofSums<Octet> sums;
  std::array<Octet, 3> momentum{};
  // Copies stay in registers: the compiler does not see that no store of a state changes them.
  const StepTerms<Octet> terms = terms_;
  const std::array<Octet, 3> ground_step = ground_step_;
  const std::array<bool, 3> shaken = shaken_;
  const bool has_extra = !extra_damping_.empty();
  Octet* const displacement = state_.displacement.data();
  Octet* const velocity = state_.velocity.data();
  const auto move_freely = [&](std::size_t i) __attribute__((always_inline)) {
    const DofState<Octet> dof{displacement[i], velocity[i]};
    const Octet before = dof.velocity;
    const Octet q = stiffness_[i] * (dof.displacement + terms.beta * before);
    if constexpr (with_energies) {
      add_energies(terms, mass_[i], q, stiffness_[i] * before, dof, energies_);
    }
    Octet f = q;
    if constexpr (filtered) {
      f = filters_.passing * q;
      for (std::size_t k = 0; k < filters_.count; ++k) {
        pass_filter(filters_.filters[k], q, state_.filtered[k][i], f);
      }
    }
    Octet ground{};
    for (std::size_t d = 0; d < 3; ++d) {
      if (shaken[d]) add_product(ground_step[d], influence_[d][i], ground);
    }
    for (const Load& load : loads_) add_product(load.step, load.shape[i], ground);
    FreeDof free{q, f, {}, free_velocity(terms, before, f, inverse_mass_[i], ground)};
    if (has_extra) {
      free.extra = extra_damping_[i] * before;
      subtract_product(terms.duration, inverse_mass_[i] * free.extra, free.velocity);
      extra_before_ += before * free.extra;
    }
    return free;
  };
  const auto settle_dof = [&](std::size_t i, const FreeDof& free, const Octet& after)
      __attribute__((always_inline)) {
    DofState<Octet> dof{displacement[i], velocity[i]};
    const Octet both = after + dof.velocity;
    if (has_extra) device_ += free.extra * both;
    if constexpr (filtered) sums.filtered += (free.acting - free.stiffness) * both;
    const Octet gained = settle(terms, free.stiffness, after, mass_[i], dof, sums);
    for (std::size_t d = 0; d < 3; ++d) {
      if (shaken[d]) add_product(influence_[d][i], gained, momentum[d]);
    }
    for (Load& load : loads_) add_product(load.shape[i], gained, load.gained);
    displacement[i] = dof.displacement;
    velocity[i] = dof.velocity;
  };
  if (dashpots_) {
    for (std::size_t i = 0; i < stiffness_.size(); ++i) free_[i] = move_freely(i);
    brake();
    for (std::size_t i = 0; i < stiffness_.size(); ++i) settle_dof(i, free_[i], velocity_[i]);
  } else {
    for (std::size_t i = 0; i < stiffness_.size(); ++i) {
      const FreeDof free = move_freely(i);
      settle_dof(i, free, free.velocity);
    }
  }
  sums_ = sums;
  momentum_ = momentum;
}

OctetLane::OctetLane(OctetStep& octet, std::size_t lane, StructureState& state)
    : octet_(octet), lane_(lane), state_(state), forces_(octet.coordinates()) {
  const auto put = [lane](std::span<const double> values, std::vector<Octet>& to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i].set(lane, values[i]);
  };
  put(state.displacement, octet.state_.displacement);
  put(state.velocity, octet.state_.velocity);
  for (std::size_t k = 0; k < state.filtered.size(); ++k) {
    put(state.filtered[k], octet.state_.filtered[k]);
  }
}

void OctetLane::take(const std::vector<Octet>& values, std::vector<double>& to) const {
  for (std::size_t i = 0; i < values.size(); ++i) to[i] = values[i][lane_];
}

const std::vector<double>& OctetLane::displacement() const {
  if (displacement_known_ != octet_.steps_) {
    take(octet_.state_.displacement, state_.displacement);
    displacement_known_ = octet_.steps_;
  }
  return state_.displacement;
}

const std::vector<double>& OctetLane::velocity() const {
  if (velocity_known_ != octet_.steps_) {
    take(octet_.state_.velocity, state_.velocity);
    velocity_known_ = octet_.steps_;
  }
  return state_.velocity;
}

void OctetLane::bring_state() const {
  displacement();
  velocity();
  for (std::size_t k = 0; k < state_.filtered.size(); ++k) {
    take(octet_.state_.filtered[k], state_.filtered[k]);
  }
}

std::span<const double> OctetLane::places(const Trace& trace) {
  const std::size_t count = trace.known().size();
  if (count == 0) return {};
  places_.resize(count);
  octet_.places_.resize(count);
  if (octet_.places_known_ != octet_.steps_) {
    multiply_rows(trace.row(0).data(), count, octet_.coordinates(),
                  octet_.state_.displacement.data(), octet_.places_.data());
    octet_.places_known_ = octet_.steps_;
  }
  take(octet_.places_, places_);
  return places_;
}

void OctetLane::remember(std::span<const LocalIndex> dofs, interactions::Before& before) const {
  const std::vector<double>& u = displacement();
  const std::vector<double>& v = velocity();
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    before.displacement[k] = u[dofs[k]];
    before.velocity[k] = v[dofs[k]];
  }
  if (forces_known_ == octet_.steps_) return;
  forces_known_ = octet_.steps_;
  const Filters<double> filters = take_filters(octet_.filters_, lane_);
  const double beta = octet_.beta_[lane_];
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const double q = octet_.stiffness_[i][lane_] * (u[i] + beta * v[i]);
    const auto memory = [&](std::size_t k) { return octet_.state_.filtered[k][i][lane_]; };
    forces_[i] = {q, filtered_force(filters, q, memory)};
  }
}

void OctetLane::act(std::span<const LocalIndex> /*dofs*/, std::span<const double> /*force*/,
                    bool /*from_rest*/) {
  throw std::logic_error("inelastic elements of a structure in generalised coordinates");
}

void OctetLane::correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
                        std::span<const double> velocity) {
  const StepTerms<double> terms = take_terms(octet_.terms_, lane_);
  DofSums<double> sums;
  StepSums& correction = octet_.corrections_[lane_];
  if (!octet_.corrected_[lane_]) correction = {};
  octet_.corrected_[lane_] = true;
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::size_t i = dofs[k];
    Octet& u = octet_.state_.displacement[i];
    Octet& v = octet_.state_.velocity[i];
    const DofState<double> old{before.displacement[k], before.velocity[k]};
    DofState<double> dof{u[lane_], v[lane_]};
    if (!octet_.extra_damping_.empty()) {
      correction.device +=
          octet_.extra_damping_[i][lane_] * old.velocity * (velocity[k] - dof.velocity);
    }
    if (octet_.brakes(lane_)) {
      correction.link_loss += octet_.dashpots_->loss_rate(i)[lane_] * (velocity[k] - dof.velocity);
    }
    const double gained =
        correct_dof(terms, octet_.mass_[i][lane_], old, velocity[k], forces_[i], dof, sums);
    for (std::size_t d = 0; d < 3; ++d) {
      correction.momentum[d] += octet_.influence_[d][i][lane_] * gained;
    }
    for (const OctetStep::Load& load : octet_.loads_) {
      const double more = load.shape[i][lane_] * gained;
      correction.support_input -= load.step[lane_] * more / 2;
      correction.load += load.value * more;
    }
    u.set(lane_, state_.displacement[i] = dof.displacement);
    v.set(lane_, state_.velocity[i] = dof.velocity);
  }
  add_to(sums, correction);
}

void OctetLane::sum_up(StepSums& total) const {
  total = {};
  if (octet_.corrected_[lane_]) total = octet_.corrections_[lane_];
  const DofEnergies<Octet>& energies = octet_.energies_;
  total.stiffness_work += octet_.sums_.stiffness_work[lane_];
  total.mass_sum += octet_.sums_.mass_sum[lane_];
  total.filtered += octet_.sums_.filtered[lane_];
  total.kinetic_before = energies.kinetic_before[lane_];
  total.stiffness_before = energies.stiffness_before[lane_];
  total.strain_before = energies.strain_before[lane_];
  total.strain_back = energies.strain_back[lane_];
  total.displacement_mass = energies.displacement_mass[lane_];
  for (std::size_t d = 0; d < 3; ++d) total.momentum[d] += octet_.momentum_[d][lane_];
  for (const OctetStep::Load& load : octet_.loads_) {
    total.support_input -= load.step[lane_] * load.gained[lane_] / 2;
    total.load += load.value * load.gained[lane_];
  }
  total.extra_damping_before = octet_.extra_before_[lane_];
  total.device += octet_.device_[lane_];
  total.link_loss += octet_.dashpot_loss_[lane_];
}

}  // namespace pounding
