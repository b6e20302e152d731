#include "dynamics/batch_step.h"

#include <algorithm>
#include <functional>

#include "common/row_products.h"

namespace pounding {
namespace {

/// Diagonal of a matrix that is nothing else; zeros where there is none.
std::vector<double> diagonal_of(const LinearSystem& system, const stiffness::Stiffness* matrix) {
  std::vector<double> diagonal(system.lumped_mass.size(), 0.0);
  if (matrix == nullptr) return diagonal;
  const VecHandle vector = wrap_vector(system, diagonal);
  POUNDING_PETSC(MatGetDiagonal(matrix->matrix(), vector.get()));
  return diagonal;
}

}  // namespace

OctetStep::OctetStep(std::span<const LinearSystem* const> systems, const LinearSystem& scene,
                     double time_step)
    : state_(std::make_unique<StateOf<Octet>>()),
      time_step_(time_step),
      stiffness_(constants_of<Octet>(
          systems, [](const auto& s) { return diagonal_of(s, s.stiffness.get()); })),
      beta_(number_of<Octet>(systems, [](const auto& s) { return s.damping.beta; })) {
  const std::vector<Octet> zeros(coordinates(), Octet{});
  state_->displacement = state_->velocity = force_ = stiffness_velocity_ = zeros;
  if (std::ranges::any_of(systems, &LinearSystem::has_extra_damping)) {
    extra_damping_ = constants_of<Octet>(
        systems, [](const auto& s) { return diagonal_of(s, s.extra_damping.get()); });
    state_->extra_force = zeros;
  }
  take_dashpots(systems, scene);
  structure_.emplace(systems, *state_, time_step, dashpots_.has_value());
  state_->filtered.assign(structure_->filters(), zeros);
  state_->inelastic_force.assign(systems.front()->inelastic.size(), Octet{});
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
  free_velocity_.resize(coordinates());
}

void OctetStep::brake(double share) {
  const std::span<Octet> velocity = structure_->waiting();
  std::ranges::copy(velocity, free_velocity_.begin());
  dashpots_->brake(share, state_->velocity, velocity);
  dashpot_loss_ = dashpots_->loss(state_->velocity, velocity);
  for (std::size_t lane = 0; lane < octet_size; ++lane) {
    if (braked_[lane]) continue;
    dashpot_loss_.set(lane, 0);
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      velocity[i].set(lane, free_velocity_[i][lane]);
    }
  }
}

void OctetStep::step(double duration, const std::array<Octet, 3>& ground_acceleration,
                     std::span<const double> loads, bool with_energies, bool with_forces) {
  ++steps_;
  extra_before_ = Octet{};
  const Octet beta = beta_;
  for (std::size_t i = 0; i < coordinates(); ++i) {
    const Octet& velocity = state_->velocity[i];
    force_[i] = stiffness_[i] * (state_->displacement[i] + beta * velocity);
    if (with_energies) stiffness_velocity_[i] = stiffness_[i] * velocity;
    if (extra_damping_.empty()) continue;
    state_->extra_force[i] = extra_damping_[i] * velocity;
    extra_before_ += velocity * state_->extra_force[i];
  }
  structure_->begin(duration, ground_acceleration,
                    {with_energies ? stiffness_velocity_.data() : nullptr, with_forces}, {}, loads);
  structure_->receive(0, static_cast<LocalIndex>(coordinates()), force_.data());
  if (dashpots_) brake(duration / time_step_);
  structure_->complete();
}

OctetLane::OctetLane(OctetStep& octet, std::size_t lane, StructureState& state)
    : SteppedRun(*octet.structure_, lane, state), octet_(octet) {
  const auto put = [lane](std::span<const double> values, std::vector<Octet>& to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i].set(lane, values[i]);
  };
  put(state.displacement, octet.state_->displacement);
  put(state.velocity, octet.state_->velocity);
  for (std::size_t k = 0; k < state.filtered.size(); ++k) {
    put(state.filtered[k], octet.state_->filtered[k]);
  }
}

void OctetLane::take(const std::vector<Octet>& values, std::vector<double>& to) const {
  for (std::size_t i = 0; i < values.size(); ++i) to[i] = values[i][lane_];
}

const std::vector<double>& OctetLane::displacement() const {
  if (displacement_known_ != octet_.steps_) {
    take(octet_.state_->displacement, state_.displacement);
    displacement_known_ = octet_.steps_;
  }
  return state_.displacement;
}

const std::vector<double>& OctetLane::velocity() const {
  if (velocity_known_ != octet_.steps_) {
    take(octet_.state_->velocity, state_.velocity);
    velocity_known_ = octet_.steps_;
  }
  return state_.velocity;
}

void OctetLane::bring_state() const {
  displacement();
  velocity();
  for (std::size_t k = 0; k < state_.filtered.size(); ++k) {
    take(octet_.state_->filtered[k], state_.filtered[k]);
  }
}

std::span<const double> OctetLane::places(const Trace& trace) {
  const std::size_t count = trace.known().size();
  if (count == 0) return {};
  places_.resize(count);
  octet_.places_.resize(count);
  if (octet_.places_known_ != octet_.steps_) {
    multiply_rows(trace.row(0).data(), count, octet_.coordinates(),
                  octet_.state_->displacement.data(), octet_.places_.data());
    octet_.places_known_ = octet_.steps_;
  }
  take(octet_.places_, places_);
  return places_;
}

void OctetLane::correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
                        std::span<const double> velocity) {
  for (std::size_t k = 0; k < dofs.size() && octet_.brakes(lane_); ++k) {
    const std::size_t i = dofs[k];
    const double change = velocity[k] - octet_.state_->velocity[i][lane_];
    const double loss = octet_.dashpots_->loss_rate(i)[lane_] * change;
    octet_.dashpot_loss_.set(lane_, octet_.dashpot_loss_[lane_] + loss);
  }
  SteppedRun::correct(dofs, before, velocity);
  for (const LocalIndex i : dofs) {
    state_.displacement[i] = octet_.state_->displacement[i][lane_];
    state_.velocity[i] = octet_.state_->velocity[i][lane_];
  }
}

StepSums OctetLane::sums() const {
  StepSums total = step_.sums(lane_);
  total.extra_damping_before = octet_.extra_before_[lane_];
  total.link_loss = octet_.dashpot_loss_[lane_];
  return total;
}

}  // namespace pounding
