#include "dynamics/unilateral_contact.h"

#include <utility>

#include "common/parallel.h"

namespace pounding {

UnilateralContact::UnilateralContact(MPI_Comm comm, interactions::ContactProblem& problem,
                                     GapWatch watch, const State& state)
    : problem_(problem),
      watch_(std::move(watch)),
      state_(state),
      counts_(problem.root() == rank_of(comm)) {
  for (std::size_t s = 0; s < state.structures.size(); ++s) {
    const std::size_t dofs = problem_.trace(s).dofs().size();
    before_.emplace_back(dofs);
    velocity_.emplace_back(dofs, 0.0);
  }
}

UnilateralContact::~UnilateralContact() = default;

void UnilateralContact::attach(std::span<interactions::SteppedStructure* const> structures) {
  for (std::size_t s = 0; s < structures.size(); ++s) {
    structures[s]->watch(problem_.trace(s).dofs(), false);
  }
}

void UnilateralContact::begin(const interactions::Step& step) {
  interface_known_ = problem_.member() && (step.look_at_gap || watch_.due(step.number));
  touching_ = false;
  if (interface_known_) detect_contact(step);
}

void UnilateralContact::push(const interactions::Step& step) {
  if (!touching_) return;
  solve_impulse(step);     // 0 <= lambda _|_ H lambda + L v_free >= 0   on A
  correct_velocity(step);  // v+ = v_free + M^-1 L^T lambda,   u_{n+1} = u_n + dt v+
}

void UnilateralContact::detect_contact(const interactions::Step& step) {
  const ScopedEvent event(events_.detect_contact);
  const ScopedTimer timer(step.profile, Phase::contact);
  ++looks_;
  for (std::size_t s = 0; s < before_.size(); ++s) {
    std::span<const double> places;
    if (step.look_at_gap) places = step.structures[s]->places(problem_.trace(s));
    if (places.empty()) {
      problem_.set_displacement(s, step.structures[s]->displacement().data(),
                                step.supports.displacement);
    } else {
      problem_.set_place_displacement(s, places);
    }
  }
  problem_.gather_displacements();
  touching_ = problem_.detect_contact();
  for (std::size_t s = 0; touching_ && s < before_.size(); ++s) {
    problem_.set_velocity_before(s, step.structures[s]->velocity().data(),
                                 step.supports.velocity_before);
    step.structures[s]->remember(problem_.trace(s).dofs(), before_[s]);
  }
  if (!touching_) {
    problem_.clear_impulse();
    if (!watch_.needs_look(step.number)) return;
    if (watch_.measures()) measure(step);
  }
  watch_.looked(step.number, problem_.smallest_gap() - problem_.gap_tolerance(), touching_);
}

void UnilateralContact::measure(const interactions::Step& step) {
  for (const interactions::SteppedStructure* structure : step.structures) structure->bring_state();
  problem_.add_over_members(watch_.measure(state_.structures));
}

void UnilateralContact::solve_impulse(const interactions::Step& step) {
  const ScopedEvent event(events_.solve_impulse);
  const ScopedTimer timer(step.profile, Phase::contact);
  for (std::size_t s = 0; s < before_.size(); ++s) {
    problem_.set_free_velocity(s, step.structures[s]->velocity().data(), step.supports.velocity);
  }
  problem_.gather_velocities();
  problem_.solve_impulse();
}

void UnilateralContact::correct_velocity(const interactions::Step& step) {
  const ScopedEvent event(events_.correct_velocity);
  const ScopedTimer timer(step.profile, Phase::contact);
  for (std::size_t s = 0; s < before_.size(); ++s) {
    const Trace& trace = problem_.trace(s);
    trace.restrict_to_dofs(step.structures[s]->velocity().data(), velocity_[s].data());
    problem_.add_velocity_change(s, velocity_[s].data());
    step.structures[s]->correct(trace.dofs(), before_[s], velocity_[s]);
  }
}

void UnilateralContact::finish(const interactions::Step& step) {
  if (!touching_) return;
  const std::vector<double>& supports = step.supports.velocity_mean;
  for (std::size_t s = 0; !supports.empty() && s < before_.size(); ++s) {
    step.ledger[s]->contact_support_input = -problem_.support_work(s, supports);
  }
  if (!counts_) return;
  step.ledger.front()->contact_work = problem_.total_work();
  step.ledger.front()->friction_loss = problem_.friction().total_loss();
}

void UnilateralContact::save(SavedState& saved) const {
  if (!counts_) return;
  watch_.save(saved);
  problem_.save(saved);
}

void UnilateralContact::load(const SavedState& saved) {
  watch_.load(saved);
  problem_.load(saved);
}

}  // namespace pounding
