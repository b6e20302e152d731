#include "dynamics/cd_lagrange.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "common/memory.h"
#include "common/parallel.h"
#include "dynamics/rest_forces.h"

namespace pounding {

CdLagrange::CdLagrange(MPI_Comm comm, std::span<const LinearSystem> systems,
                       const GroundMotion& motion, interactions::ContactProblem* contact,
                       FillerStep* fillers, GapWatch watch, double time_step, Profile& profile,
                       const SupportMotion* supports)
    : systems_(systems),
      motion_(motion),
      support_motion_(supports),
      contact_(contact),
      fillers_(fillers),
      watch_(std::move(watch)),
      time_step_(time_step),
      profile_(profile),
      state_(systems, supports != nullptr ? supports->columns().size() : 0),
      supports_(state_.supports.displacement.size()),
      energy_(comm, systems, time_step),
      counts_work_(contact != nullptr && contact->root() == rank_of(comm)),
      sums_(systems.size()) {
  structure_steps_.reserve(systems_.size());
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    StructureState& state = state_.structures[s];
    structure_steps_.emplace_back(systems_[s], state, time_step);
    vectors_.emplace_back(systems_[s], state);
    extra_forces_.push_back(systems_[s].has_extra_damping()
                                ? wrap_vector(systems_[s], state.extra_force)
                                : VecHandle());
    link_steps_.push_back(systems_[s].links
                              ? std::make_unique<LinkStep>(systems_[s], state, structure_steps_[s],
                                                           supports_, time_step)
                              : nullptr);
    stiffness_velocity_.push_back(zeros_on_large_pages(state.velocity.size()));
    start_filters(systems_[s], time_step, state);
    rest_forces_.push_back(rest_forces(systems_[s]));
    if (fillers_ != nullptr) structure_steps_[s].watch(fillers_->rows().trace(s).dofs(), true);
    if (contact_ != nullptr) structure_steps_[s].watch(contact_->trace(s).dofs(), false);
  }
  for (std::size_t s = 0; contact_ != nullptr && s < systems_.size(); ++s) {
    const std::size_t dofs = contact_->trace(s).dofs().size();
    before_.emplace_back(dofs);
    interface_velocity_.emplace_back(dofs, 0.0);
  }
}

void CdLagrange::step(bool look_at_gap, bool with_energies, bool with_forces) {
  force_duration_ = state_.step == 0 ? time_step_ / 2 : time_step_;
  const double time = static_cast<double>(state_.step) * time_step_;
  motion_.evaluate(time, acceleration_);
  motion_.evaluate_incident(time, incident_);
  if (support_motion_ != nullptr) support_motion_->evaluate(time, supports_.acceleration);
  supports_.begin(state_.supports, force_duration_);

  detect_contact(look_at_gap);  // A = { i : g_i(u_n) <= g_tol }
  if (fillers_ != nullptr) measure_fillers();
  // v_free = v- + dt (g - iota a_g - alpha v-) - dt M^-1 (K w + D v-), less dt M^-1 b N of links
  free_velocity(with_energies, with_forces || touching_);
  if (fillers_ != nullptr) press_fillers();  // v_free -= dt M^-1 b N
  if (touching_) {
    solve_impulse();     // 0 <= lambda _|_ H lambda + L v_free >= 0   on A
    correct_velocity();  // v+ = v_free + M^-1 L^T lambda,   u_{n+1} = u_n + dt v+
  }
  close_energy();  // E+ - E- = -dt vbar^T C vbar + dt vbar^T (f - b N) + 1/2 lambda^T L v-
  supports_.finish(time_step_, state_.supports);
  ++state_.step;
}

void CdLagrange::detect_contact(bool look_at_gap) {
  interface_known_ =
      contact_ != nullptr && contact_->member() && (look_at_gap || watch_.due(state_.step));
  touching_ = false;
  if (!interface_known_) return;
  const ScopedEvent event(events_.detect_contact);
  const ScopedTimer timer(profile_, Phase::contact);
  ++looks_;
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    contact_->set_displacement(s, state_.structures[s].displacement.data(), supports_.displacement);
  }
  contact_->gather_displacements();
  touching_ = contact_->detect_contact();
  for (std::size_t s = 0; touching_ && s < systems_.size(); ++s) {
    contact_->set_velocity_before(s, state_.structures[s].velocity.data(),
                                  supports_.velocity_before);
    structure_steps_[s].remember(contact_->trace(s).dofs(), before_[s]);
  }
  if (!touching_) {
    contact_->clear_impulse();
    if (!watch_.needs_look(state_.step)) return;
    if (watch_.measures()) contact_->add_over_members(watch_.measure(state_.structures));
  }
  watch_.looked(state_.step, contact_->smallest_gap() - contact_->gap_tolerance(), touching_);
}

double CdLagrange::about_rest(std::size_t structure) const {
  const std::vector<double>& held = rest_forces_[structure];
  const std::vector<double>& rest = systems_[structure].rest_displacement;
  const StructureState& state = state_.structures[structure];
  double sum = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double mean = state.displacement[i] - time_step_ / 2 * state.velocity[i];
    sum += held[i] * (rest[i] / 2 - mean);
  }
  return sum;
}

void CdLagrange::free_velocity(bool with_energies, bool with_forces) {
  const ScopedEvent event(events_.free_velocity);
  const ScopedTimer timer(profile_, Phase::step);
  const bool first = state_.step == 0;
  with_energies = with_energies || energy_.needs_energies();
  for (std::size_t s = 0; with_energies && s < systems_.size(); ++s) {
    const double* const velocity = state_.structures[s].velocity.data();
    stiffness::StoredForces store(stiffness_velocity_[s].data());
    systems_[s].stiffness->apply({velocity, velocity, 0}, store);
    sums_[s].rest_before = about_rest(s);
  }
  for (std::size_t s = 0; s < systems_.size(); ++s) systems_[s].stiffness->start(argument(s));
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    sums_[s].extra_damping_before = apply_extra_damping(s);
    if (link_steps_[s]) link_steps_[s]->begin(incident_);
    const double* const rate = with_energies ? stiffness_velocity_[s].data() : nullptr;
    structure_steps_[s].begin(force_duration_, acceleration_, {rate, with_forces},
                              supports_.acceleration);
    systems_[s].stiffness->finish(argument(s), structure_steps_[s]);
    structure_steps_[s].complete();
    if (link_steps_[s]) link_steps_[s]->pull(first);
  }
}

void CdLagrange::measure_fillers() {
  const ScopedTimer timer(profile_, Phase::contact);
  fillers_->begin(state_.structures, structure_steps_, supports_);
}

void CdLagrange::press_fillers() {
  const ScopedTimer timer(profile_, Phase::contact);
  fillers_->press(state_.step == 0, state_.structures, structure_steps_, supports_);
}

void CdLagrange::solve_impulse() {
  const ScopedEvent event(events_.solve_impulse);
  const ScopedTimer timer(profile_, Phase::contact);
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    contact_->set_free_velocity(s, state_.structures[s].velocity.data(), supports_.velocity);
  }
  contact_->gather_velocities();
  contact_->solve_impulse();
}

void CdLagrange::correct_velocity() {
  const ScopedEvent event(events_.correct_velocity);
  const ScopedTimer timer(profile_, Phase::contact);
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    double* const velocity = interface_velocity_[s].data();
    contact_->trace(s).restrict_to_dofs(state_.structures[s].velocity.data(), velocity);
    contact_->add_velocity_change(s, velocity);
    structure_steps_[s].correct(contact_->trace(s).dofs(), before_[s], interface_velocity_[s]);
  }
}

void CdLagrange::close_energy() {
  const ScopedEvent event(events_.close_energy);
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    const StepSums before = sums_[s];
    sums_[s] = structure_steps_[s].sums();
    sums_[s].extra_damping_before = before.extra_damping_before;
    sums_[s].rest_before = before.rest_before;
    if (link_steps_[s]) link_steps_[s]->finish(sums_[s]);
    if (touching_ && systems_[s].supports) {
      sums_[s].contact_support_input = -contact_->support_work(s, supports_.velocity_mean);
    }
  }
  if (fillers_ != nullptr) fillers_->finish(sums_[0]);
  ContactWork work;
  if (touching_ && counts_work_) {
    work = {contact_->total_work(), contact_->friction().total_loss()};
  }
  energy_.add_step(sums_, acceleration_, work);
}

void CdLagrange::save(SavedState& saved) const {
  state_.save(saved);
  energy_.save(saved);
  for (std::size_t s = 0; s < link_steps_.size(); ++s) {
    if (link_steps_[s]) link_steps_[s]->save(static_cast<int>(s), saved);
  }
  if (fillers_ != nullptr) fillers_->save(saved);
  if (counts_work_) {
    watch_.save(saved);
    contact_->save(saved);
  }
}

void CdLagrange::load(const SavedState& saved) {
  state_.load(saved);
  energy_.load(saved);
  for (std::size_t s = 0; s < link_steps_.size(); ++s) {
    if (link_steps_[s]) link_steps_[s]->load(static_cast<int>(s), saved);
  }
  if (fillers_ != nullptr) fillers_->load(saved);
  if (contact_ != nullptr) {
    watch_.load(saved);
    contact_->load(saved);
  }
}

stiffness::StiffnessArgument CdLagrange::argument(std::size_t s) const {
  const StructureState& state = state_.structures[s];
  return {state.displacement.data(), state.velocity.data(), systems_[s].damping.beta};
}

double CdLagrange::apply_extra_damping(std::size_t s) {
  if (!systems_[s].has_extra_damping()) return 0;
  systems_[s].extra_damping->apply(vectors_[s].velocity(), extra_forces_[s].get());
  const StructureState& state = state_.structures[s];
  return std::inner_product(state.velocity.begin(), state.velocity.end(), state.extra_force.begin(),
                            0.0);
}

}  // namespace pounding
