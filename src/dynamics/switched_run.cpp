#include "dynamics/switched_run.h"

#include <algorithm>
#include <numeric>

#include "common/parallel.h"
#include "common/row_products.h"

namespace pounding {

std::vector<double> SwitchedModes::squares() const {
  return stiffness_times(system, std::vector<double>(size(), 1.0));
}

std::vector<double> SwitchedModes::weighted(std::span<const LocalIndex> dofs,
                                            std::span<const double> weights) const {
  std::vector<double> sums(size(), 0.0);
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const double* const phi = row(static_cast<std::size_t>(dofs[k]));
    for (std::size_t j = 0; j < size(); ++j) sums[j] += weights[k] * phi[j];
  }
  return sums;
}

std::vector<double> SwitchedModes::weighted(std::span<const double> weights) const {
  std::vector<LocalIndex> dofs(weights.size());
  std::iota(dofs.begin(), dofs.end(), LocalIndex{0});
  return weighted(dofs, weights);
}

SwitchedRun::SwitchedRun(const LinearSystem& system, std::size_t number,
                         StructureStep<double>& step, StructureState& state, EnergyBalance& energy,
                         double time_step)
    : SteppedRun(step, 0, state),
      system_(system),
      modes_(*system.switched),
      number_(number),
      energy_(energy),
      time_step_(time_step),
      first_rank_(rank_of(system.comm) == 0),
      coordinates_({&modes_.system, 1}),
      q_(coordinates_.structures.front()),
      fields_{&q_.displacement, &q_.velocity},
      step_in_modes_(std::array{&modes_.system}, q_, time_step),
      links_(system, modes_.system, modes_.links, time_step),
      all_(modes_.size()),
      before_(modes_.size()),
      velocity_(modes_.size()),
      stiffness_velocity_(modes_.size()),
      rest_force_(rest_forces(modes_.system)) {
  for (std::vector<double>& memory : q_.filtered) fields_.push_back(&memory);
  std::iota(all_.begin(), all_.end(), LocalIndex{0});
  step_in_modes_.watch(all_, !links_.empty());
}

void SwitchedRun::bring(std::span<const LocalIndex> dofs) const {
  for (std::size_t k = 0; in_modes_ && k < dofs.size(); ++k) {
    const auto i = static_cast<std::size_t>(dofs[k]);
    multiply_rows(modes_.row(i), 1, modes_.size(), q_.displacement.data(), &state_.displacement[i]);
    multiply_rows(modes_.row(i), 1, modes_.size(), q_.velocity.data(), &state_.velocity[i]);
  }
}

void SwitchedRun::expand(const std::vector<double>& q, std::vector<double>& values) const {
  multiply_rows(modes_.row(0), values.size(), q.size(), q.data(), values.data());
}

void SwitchedRun::bring_all() const {
  if (!in_modes_) return;
  expand(q_.displacement, state_.displacement);
  expand(q_.velocity, state_.velocity);
}

bool SwitchedRun::fits_modes() {
  const std::size_t size = modes_.size();
  const std::size_t dofs = system_.lumped_mass.size();
  std::vector<double> parts(fields_.size() * size, 0.0);
  for (std::size_t i = 0; i < dofs; ++i) {
    const double* const phi = modes_.row(i);
    const double mass = system_.lumped_mass[i];
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      const double value = f == 0   ? mass * state_.displacement[i]
                           : f == 1 ? mass * state_.velocity[i]
                                    : state_.filtered[f - 2][i];
      for (std::size_t j = 0; j < size; ++j) parts[f * size + j] += value * phi[j];
    }
  }
  reduce_over_ranks(system_.comm, MPI_SUM, parts);
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    std::copy_n(&parts[f * size], size, fields_[f]->begin());
  }
  std::vector<double> displacement(dofs);
  std::vector<double> velocity(dofs);
  expand(q_.displacement, displacement);
  expand(q_.velocity, velocity);
  for (std::size_t i = 0; i < dofs; ++i) {
    displacement[i] = state_.displacement[i] - displacement[i];
    velocity[i] = state_.velocity[i] - velocity[i];
  }
  double outside = energy_.energy(number_, energies(system_, displacement, velocity)).energy();
  reduce_over_ranks(system_.comm, MPI_SUM, outside);
  note_energy(outside);
  return outside <= modes_.part * largest_energy_;
}

void SwitchedRun::note_energy(double outside) {
  std::vector<double> moved = q_.displacement;
  const std::vector<double>& rest = modes_.system.rest_displacement;
  for (std::size_t i = 0; i < rest.size(); ++i) moved[i] -= rest[i];
  const StepSums sums = energies(modes_.system, moved, q_.velocity);
  largest_energy_ = std::max(largest_energy_, outside + energy_.energy(number_, sums).energy());
}

StepSums SwitchedRun::energies(const LinearSystem& system, const std::vector<double>& displacement,
                               const std::vector<double>& velocity) const {
  const std::vector<double> rate = stiffness_times(system, velocity);
  const std::vector<double> force = stiffness_times(system, displacement);
  StepSums sums;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    sums.kinetic_before += system.lumped_mass[i] * velocity[i] * velocity[i];
    sums.stiffness_before += velocity[i] * rate[i];
    sums.strain_before += displacement[i] * (force[i] - time_step_ * rate[i]);
    sums.strain_back += (displacement[i] - time_step_ * velocity[i]) * force[i];
  }
  return sums;
}

StepSums SwitchedRun::energies_in_modes() const {
  if (!first_rank_) return {};
  StepSums sums = energies(modes_.system, q_.displacement, q_.velocity);
  sums.link_energy_before = links_.energy_in_modes(q_.velocity);
  return sums;
}

StepSums SwitchedRun::energies_at_full_order() const {
  StepSums sums = energies(system_, state_.displacement, state_.velocity);
  sums.link_energy_before = links_.energy_of_own(state_.velocity);
  return sums;
}

void SwitchedRun::enter_modes() {
  links_.gather();
  energy_.change_order(number_, energies_at_full_order(), energies_in_modes());
  in_modes_ = true;
}

void SwitchedRun::leave_modes() {
  note_energy(0);
  bring_all();
  const std::vector<double> squares = modes_.squares();
  const Filters<double> filters = filters_of(modes_.system, time_step_);
  for (std::size_t f = 0; f < q_.filtered.size(); ++f) {
    if (filters.filters[f].take == 0) continue;
    std::vector<double> motion = q_.filtered[f];  // whose force the memory is
    for (std::size_t j = 0; j < motion.size(); ++j) {
      motion[j] = squares[j] > 0 ? motion[j] / squares[j] : 0;
    }
    std::vector<double> moved(system_.lumped_mass.size());
    expand(motion, moved);
    state_.filtered[f] = stiffness_times(system_, moved);
  }
  links_.give_back();
  in_modes_ = false;
  energy_.change_order(number_, energies_in_modes(), energies_at_full_order());
}

void SwitchedRun::step(const std::array<double, 3>& ground_acceleration, bool with_energies,
                       bool with_forces, std::span<const double> supports,
                       std::span<const double> loads) {
  const LinearSystem& system = modes_.system;
  const double* const velocity = q_.velocity.data();
  if (with_energies) {
    stiffness::StoredForces store(stiffness_velocity_.data());
    system.stiffness->apply({velocity, velocity, 0}, store);
  }
  step_in_modes_.remember(0, all_, before_);
  const double* const rate = with_energies ? stiffness_velocity_.data() : nullptr;
  step_in_modes_.begin(time_step_, ground_acceleration, {rate, with_forces}, supports, loads);
  system.stiffness->apply({q_.displacement.data(), velocity, system.damping.beta}, step_in_modes_);
  step_in_modes_.complete();
  if (links_.empty()) return;
  velocity_ = q_.velocity;
  links_.push(before_.velocity, velocity_);
  step_in_modes_.correct(0, all_, before_, velocity_);
}

StepSums SwitchedRun::sums() const {
  if (!first_rank_) return {};
  StepSums sums = step_in_modes_.sums(0);
  sums.link_energy_before = links_.energy();
  sums.link_loss = links_.loss();
  return sums;
}

double SwitchedRun::about_rest() const {
  return first_rank_ ? rest_work(rest_force_, modes_.system, q_, time_step_) : 0;
}

void SwitchedRun::keep(const StateKeeper& state) {
  if (state.puts()) {
    bring_all();
    if (in_modes_) links_.give_back();
  }
  const std::string name = "modes_" + std::to_string(number_);
  state.numbers(name, in_modes_, largest_energy_);
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    state.table(name + "_" + std::to_string(f), *fields_[f]);
  }
  if (!state.puts()) links_.gather();
}

}  // namespace pounding
