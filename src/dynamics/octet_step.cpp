#include "dynamics/octet_step.h"

#include <algorithm>

#include "dynamics/structure_step.h"

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

OctetState::OctetState(std::size_t coordinates, std::size_t filters)
    : displacement(coordinates, Octet{}),
      velocity(coordinates, Octet{}),
      filtered(filters, std::vector<Octet>(coordinates, Octet{})) {}

void OctetState::put(std::size_t lane, const StructureState& state) {
  for (std::size_t i = 0; i < displacement.size(); ++i) {
    displacement[i].set(lane, state.displacement[i]);
    velocity[i].set(lane, state.velocity[i]);
    for (std::size_t k = 0; k < state.filtered.size(); ++k) {
      filtered[k][i].set(lane, state.filtered[k][i]);
    }
  }
}

void OctetState::take(const std::vector<Octet>& values, std::size_t lane, std::span<double> to) {
  for (std::size_t i = 0; i < values.size(); ++i) to[i] = values[i][lane];
}

OctetStep::OctetStep(std::span<const LinearSystem* const> systems, double time_step)
    : time_step_(time_step) {
  filters_.passing = all_octet(1);
  for (auto& [weight, keep, take] : filters_.filters) weight = keep = take = Octet{};
  for (std::size_t lane = 0; lane < systems.size(); ++lane) {
    if (systems[lane] != nullptr) take_system(*systems[lane], time_step, lane);
  }
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
}

void OctetStep::step(double duration, const std::array<Octet, 3>& ground_acceleration,
                     bool with_energies, OctetState& state) {
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
  sums_ = DofSums<Octet>{};
  energies_ = DofEnergies<Octet>{};
  extra_before_ = device_ = Octet{};
  corrections_.fill({});
  if (filters_.count > 0) {
    with_energies ? advance<true, true>(state) : advance<false, true>(state);
  } else {
    with_energies ? advance<true, false>(state) : advance<false, false>(state);
  }
}

template <bool with_energies, bool filtered>
void OctetStep::advance(OctetState& state) {
  DofSums<Octet> sums;
  std::array<Octet, 3> momentum{};
  // Copies stay in registers: the compiler cannot tell that no store of a state changes them.
  const StepTerms<Octet> terms = terms_;
  const std::array<Octet, 3> ground_step = ground_step_;
  const std::array<bool, 3> shaken = shaken_;
  const bool has_extra = !extra_damping_.empty();
  Octet* const displacement = state.displacement.data();
  Octet* const velocity = state.velocity.data();
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    DofState<Octet> dof{displacement[i], velocity[i]};
    const Octet before = dof.velocity;
    const Octet q = stiffness_[i] * (dof.displacement + terms.beta * before);
    if constexpr (with_energies) {
      add_energies(terms, mass_[i], q, stiffness_[i] * before, dof, energies_);
    }
    Octet f = q;
    if constexpr (filtered) {
      f = filters_.passing * q;
      for (std::size_t k = 0; k < filters_.count; ++k) {
        pass_filter(filters_.filters[k], q, state.filtered[k][i], f);
      }
    }
    Octet ground{};
    for (std::size_t d = 0; d < 3; ++d) {
      if (shaken[d]) add_product(ground_step[d], influence_[d][i], ground);
    }
    Octet free = free_velocity(terms, before, f, inverse_mass_[i], ground);
    if (has_extra) {
      const Octet extra = extra_damping_[i] * before;
      subtract_product(terms.duration, inverse_mass_[i] * extra, free);
      extra_before_ += before * extra;
      device_ += extra * (free + before);
    }
    if constexpr (filtered) sums.filtered += (f - q) * (free + before);
    const Octet gained = settle(terms, q, free, mass_[i], dof, sums);
    for (std::size_t d = 0; d < 3; ++d) {
      if (shaken[d]) add_product(influence_[d][i], gained, momentum[d]);
    }
    displacement[i] = dof.displacement;
    velocity[i] = dof.velocity;
  }
  sums_ = sums;
  momentum_ = momentum;
}

void OctetStep::remember(const OctetState& state, std::size_t lane, Before& before) const {
  OctetState::take(state.displacement, lane, before.displacement);
  OctetState::take(state.velocity, lane, before.velocity);
  const Filters<double> filters = take_filters(filters_, lane);
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    const double q =
        stiffness_[i][lane] * (before.displacement[i] + beta_[lane] * before.velocity[i]);
    const double f =
        filtered_force(filters, q, [&](std::size_t k) { return state.filtered[k][i][lane]; });
    before.forces[i] = {q, f};
  }
}

void OctetStep::correct(std::size_t lane, const Before& before, std::span<const double> velocity,
                        OctetState& state) {
  const StepTerms<double> terms = take_terms(terms_, lane);
  DofSums<double> sums;
  StepSums& correction = corrections_[lane];
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    const DofState<double> old{before.displacement[i], before.velocity[i]};
    DofState<double> dof{state.displacement[i][lane], state.velocity[i][lane]};
    if (!extra_damping_.empty()) {
      correction.device +=
          extra_damping_[i][lane] * before.velocity[i] * (velocity[i] - dof.velocity);
    }
    const double gained =
        correct_dof(terms, mass_[i][lane], old, velocity[i], before.forces[i], dof, sums);
    for (std::size_t d = 0; d < 3; ++d) correction.momentum[d] += influence_[d][i][lane] * gained;
    state.velocity[i].set(lane, dof.velocity);
    state.displacement[i].set(lane, dof.displacement);
  }
  add_to(sums, correction);
}

StepSums OctetStep::sums(std::size_t lane) const {
  StepSums total = corrections_[lane];
  total.stiffness_work += sums_.stiffness_work[lane];
  total.mass_sum += sums_.mass_sum[lane];
  total.filtered += sums_.filtered[lane];
  total.kinetic_before = energies_.kinetic_before[lane];
  total.stiffness_before = energies_.stiffness_before[lane];
  total.strain_before = energies_.strain_before[lane];
  total.strain_back = energies_.strain_back[lane];
  total.displacement_mass = energies_.displacement_mass[lane];
  for (std::size_t d = 0; d < 3; ++d) total.momentum[d] += momentum_[d][lane];
  total.extra_damping_before = extra_before_[lane];
  total.device += device_[lane];
  return total;
}

}  // namespace pounding
