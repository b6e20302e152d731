#include "dynamics/cd_lagrange.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "common/parallel.h"

namespace pounding {

CdLagrange::CdLagrange(MPI_Comm comm, std::span<const LinearSystem> systems,
                       const GroundMotion& motion, ContactProblem* contact, GapWatch watch,
                       double time_step, Profile& profile)
    : systems_(systems),
      motion_(motion),
      contact_(contact),
      watch_(std::move(watch)),
      time_step_(time_step),
      profile_(profile),
      state_(systems),
      energy_(comm, systems, time_step),
      counts_work_(contact != nullptr && contact->root() == rank_of(comm)),
      sums_(systems.size()) {
  body_steps_.reserve(systems_.size());
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    BodyState& body = state_.bodies[b];
    body_steps_.emplace_back(systems_[b], body, time_step);
    device_velocities_.emplace_back();
    device_forces_.emplace_back();
    if (systems_[b].has_devices()) {
      device_velocities_[b] = wrap_vector(systems_[b], body.velocity);
      device_forces_[b] = wrap_vector(systems_[b], body.device_force);
    }
    const bool bars = systems_[b].tension_bars != nullptr;
    bar_steps_.push_back(
        bars ? std::make_unique<TensionBarStep>(systems_[b], body, body_steps_[b], time_step)
             : nullptr);
    StoredForces store(body.stiffness_displacement.data());  // K u_0
    systems_[b].stiffness->apply({body.displacement.data(), body.displacement.data(), 0}, store);
  }
  for (std::size_t b = 0; contact_ != nullptr && b < systems_.size(); ++b) {
    const std::size_t dofs = contact_->trace(b).dofs().size();
    before_.emplace_back(dofs);
    interface_velocity_.emplace_back(dofs, 0.0);
  }
}

void CdLagrange::step(bool look_at_gap, bool with_energies) {
  const bool first = state_.step == 0;
  interface_known_ =
      contact_ != nullptr && contact_->member() && (look_at_gap || watch_.due(state_.step));
  force_duration_ = first ? time_step_ / 2 : time_step_;
  motion_.evaluate(static_cast<double>(state_.step) * time_step_, acceleration_);
  touching_ = interface_known_ && look_at_interface();  // g_i(u_n), A
  {
    const ScopedTimer timer(profile_, Phase::step);
    for (std::size_t b = 0; b < systems_.size(); ++b) {
      systems_[b].stiffness->start(argument(b));
    }
    for (std::size_t b = 0; b < systems_.size(); ++b) {
      sums_[b].extra_damping_before = apply_devices(b);
      if (bar_steps_[b]) {
        bar_steps_[b]->begin();
      }
      body_steps_[b].begin(force_duration_, acceleration_, first,
                           with_energies || energy_.needs_energies());
      systems_[b].stiffness->finish(argument(b), body_steps_[b]);  // q, v_free, u_{n+1}
      body_steps_[b].complete();
      if (bar_steps_[b]) {
        bar_steps_[b]->pull(first);
      }
    }
  }
  if (touching_) {
    solve_contact();  // lambda, v_{n+1/2}
  }
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    const double extra_damping = sums_[b].extra_damping_before;
    sums_[b] = body_steps_[b].sums();
    sums_[b].extra_damping_before = extra_damping;
    if (bar_steps_[b]) {
      bar_steps_[b]->finish(sums_[b]);
    }
  }
  energy_.add_step(sums_, acceleration_, touching_ && counts_work_ ? contact_->total_work() : 0);
  ++state_.step;
}

void CdLagrange::save(SavedState& saved) const {
  state_.save(saved);
  energy_.save(saved);
  if (counts_work_) {
    watch_.save(saved);
    contact_->save(saved);
  }
}

void CdLagrange::load(const SavedState& saved) {
  state_.load(saved);
  energy_.load(saved);
  if (contact_ != nullptr) {
    watch_.load(saved);
    contact_->load(saved);
  }
}

StiffnessArgument CdLagrange::argument(std::size_t b) const {
  const BodyState& body = state_.bodies[b];
  return {body.displacement.data(), body.velocity.data(), systems_[b].damping.beta};
}

double CdLagrange::apply_devices(std::size_t b) {
  const LinearSystem& system = systems_[b];
  BodyState& body = state_.bodies[b];
  double extra_damping = 0;  // v-^T D v-
  if (system.extra_damping) {
    system.extra_damping->apply(device_velocities_[b].get(), device_forces_[b].get());
    extra_damping = std::inner_product(body.velocity.begin(), body.velocity.end(),
                                       body.device_force.begin(), 0.0);
  }
  return extra_damping;
}

bool CdLagrange::look_at_interface() {
  const ScopedTimer timer(profile_, Phase::contact);
  ++looks_;
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    contact_->set_displacement(b, state_.bodies[b].displacement.data());
  }
  contact_->gather_displacements();
  const bool touching = contact_->detect_contact();
  for (std::size_t b = 0; touching && b < systems_.size(); ++b) {
    contact_->set_velocity_before(b, state_.bodies[b].velocity.data());
    body_steps_[b].remember(contact_->trace(b).dofs(), before_[b]);
  }
  if (!touching) {
    contact_->clear_impulse();
    if (watch_.measures()) {
      contact_->add_over_members(watch_.measure(state_.bodies));
    }
  }
  watch_.looked(state_.step, contact_->smallest_gap() - contact_->gap_tolerance(), touching);
  return touching;
}

void CdLagrange::solve_contact() {
  const ScopedTimer timer(profile_, Phase::contact);
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    contact_->set_free_velocity(b, state_.bodies[b].velocity.data());
  }
  contact_->gather_velocities();
  contact_->solve_impulse();
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    double* const velocity = interface_velocity_[b].data();
    contact_->trace(b).restrict_to_dofs(state_.bodies[b].velocity.data(), velocity);
    contact_->add_velocity_change(b, velocity);
    body_steps_[b].correct(contact_->trace(b).dofs(), before_[b], interface_velocity_[b]);
  }
}

}  // namespace pounding
