#include "dynamics/cd_lagrange.h"

#include <algorithm>
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
      energy_(comm, systems, {motion.active(0), motion.active(1), motion.active(2)}, time_step),
      counts_work_(contact != nullptr && contact->root() == rank_of(comm)) {
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    BodyState& body = state_.bodies[b];
    arguments_.push_back(wrap_vector(systems_[b], body.stiffness_argument));
    forces_.push_back(wrap_vector(systems_[b], body.stiffness_force));
    if (systems_[b].has_devices()) {
      dashpot_velocities_.push_back(wrap_vector(systems_[b], body.velocity_half));
      device_forces_.push_back(wrap_vector(systems_[b], body.device_force));
    } else {
      dashpot_velocities_.emplace_back();
      device_forces_.emplace_back();
    }
    displacements_.push_back(body.displacement.data());
    velocities_.push_back(body.velocity_half.data());
    const_velocities_.push_back(body.velocity_half.data());
  }
}

void CdLagrange::step(bool look_at_gap, bool with_energies) {
  if (started_) {
    advance_displacement();  // u_{n+1} = u_n + dt v_{n+1/2}
  }
  apply_stiffness();  // q = K (u_{n+1} + beta v_{n+1/2})
  if (started_) {
    const ScopedTimer timer(profile_, Phase::energy);
    energy_.close_previous_step(state_, with_energies);
  }
  apply_devices();
  force_duration_ = started_ ? time_step_ : time_step_ / 2;
  motion_.evaluate(time(), acceleration_);
  if (contact_ != nullptr && contact_->member()) {
    contact_->remember_velocity(const_velocities_);
  }
  compute_free_velocity(force_duration_);  // v_free
  touching_ = solve_contact(look_at_gap);  // A, lambda, v_{n+3/2}
  energy_.add_step(acceleration_, touching_ && counts_work_ ? contact_->total_work() : 0);
  started_ = true;
}

void CdLagrange::advance_displacement() {
  const ScopedTimer timer(profile_, Phase::advance_displacement);
  ++state_.step;
  for (BodyState& body : state_.bodies) {
    const std::size_t n = body.displacement.size();
    double* const u = body.displacement.data();
    const double* const v = body.velocity_half.data();
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += time_step_ * v[i];
    }
  }
}

void CdLagrange::apply_stiffness() {
  const ScopedTimer timer(profile_, Phase::stiffness);
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    BodyState& body = state_.bodies[b];
    const double beta = systems_[b].damping.beta;
    const std::size_t n = body.displacement.size();
    for (std::size_t i = 0; i < n; ++i) {
      body.stiffness_argument[i] = body.displacement[i] + beta * body.velocity_half[i];
    }
    systems_[b].stiffness->apply(arguments_[b].get(), forces_[b].get());
  }
}

void CdLagrange::apply_devices() {
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    const LinearSystem& system = systems_[b];
    BodyState& body = state_.bodies[b];
    if (system.dashpots) {
      system.dashpots->apply(dashpot_velocities_[b].get(), device_forces_[b].get());
    } else {
      std::fill(body.device_force.begin(), body.device_force.end(), 0.0);
    }
    if (system.tension_bars) {
      system.tension_bars->add_force(body.stiffness_argument.data(), body.device_force.data());
    }
  }
}

void CdLagrange::compute_free_velocity(double duration) {
  const ScopedTimer timer(profile_, Phase::free_velocity);
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    const LinearSystem& system = systems_[b];
    BodyState& body = state_.bodies[b];
    const std::size_t n = body.displacement.size();
    const double* const inverse_mass = system.inverse_mass.data();
    const double* const q = body.stiffness_force.data();
    double* const v = body.velocity_half.data();
    const double decay = 1 - duration * system.damping.alpha;
    for (std::size_t i = 0; i < n; ++i) {
      v[i] = decay * v[i] - duration * (inverse_mass[i] * q[i]);
    }
    for (std::size_t i = 0; i < body.device_force.size(); ++i) {
      v[i] -= duration * (inverse_mass[i] * body.device_force[i]);
    }
    for (std::size_t d = 0; d < 3; ++d) {
      const double ground_step = duration * (acceleration_[d] - system.gravity[d]);
      if (ground_step != 0) {
        const double* const influence = system.influence[d].data();
        for (std::size_t i = 0; i < n; ++i) {
          v[i] -= ground_step * influence[i];
        }
      }
    }
  }
}

bool CdLagrange::solve_contact(bool look_at_gap) {
  interface_known_ = false;
  if (contact_ == nullptr || !contact_->member() || !(look_at_gap || watch_.due(state_.step))) {
    return false;
  }
  const ScopedTimer timer(profile_, Phase::contact);
  contact_->gather(displacements_, const_velocities_);
  interface_known_ = true;
  const bool touching = contact_->detect_contact();
  contact_->solve_impulse();
  if (touching) {
    contact_->correct_velocity(velocities_);
  }
  watch_.looked(state_.step, contact_->smallest_gap() - contact_->gap_tolerance(), touching);
  return touching;
}

}  // namespace pounding
