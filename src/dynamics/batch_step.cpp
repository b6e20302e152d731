#include "dynamics/batch_step.h"

#include <algorithm>
#include <functional>

#include "common/memory.h"
#include "common/row_products.h"
#include "system/support_shapes.h"

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

BatchStep::BatchStep(std::span<const LinearSystem* const> systems, const LinearSystem& scene,
                     double time_step, const stiffness::BatchStiffness* elements)
    : state_(std::make_unique<StateOf<BatchValue>>()),
      time_step_(time_step),
      elements_(elements),
      beta_(number_of<BatchValue>(systems, [](const auto& s) { return s.damping.beta; })) {
  const std::size_t size = systems.front()->lumped_mass.size();
  for (auto* const values : {&state_->displacement, &state_->velocity, &stiffness_velocity_}) {
    *values = zeros_on_large_pages<BatchValue>(size);
  }
  if (elements_ == nullptr) take_diagonals(systems);
  take_dashpots(systems, scene);
  structure_.emplace(systems, *state_, time_step, dashpots_.has_value());
  for (std::size_t k = 0; k < structure_->filters(); ++k) {
    state_->filtered.push_back(zeros_on_large_pages<BatchValue>(size));
  }
  state_->inelastic_force.assign(systems.front()->inelastic.size(), BatchValue{});
}

void BatchStep::take_diagonals(std::span<const LinearSystem* const> systems) {
  stiffness_ = constants_of<BatchValue>(
      systems, [](const auto& s) { return diagonal_of(s, s.stiffness.get()); });
  force_.assign(coordinates(), BatchValue{});
  if (std::ranges::none_of(systems, &LinearSystem::has_extra_damping)) return;
  extra_damping_ = constants_of<BatchValue>(
      systems, [](const auto& s) { return diagonal_of(s, s.extra_damping.get()); });
  state_->extra_force = force_;
}

double BatchStep::memory_per_dof(const LinearSystem& system) {
  const std::size_t filters =
      system.uniform_damping ? system.uniform_damping->filters.size() + 1 : 0;
  const std::size_t columns = system.supports ? system.supports->shape.size() + 1 : 0;
  // u, v, K v and w, q of the product; of the runs u, v and the arrays of a LinearSystem.
  const std::size_t together = 5 + filters + columns;
  const std::size_t alone = 2 + filters + columns + 3;
  return static_cast<double>((together + alone) * sizeof(BatchValue));
}

void BatchStep::take_dashpots(std::span<const LinearSystem* const> systems,
                              const LinearSystem& scene) {
  const auto dashpots = interactions::dashpot_rows(scene);
  if (!dashpots) return;
  for (std::size_t member = 0; member < systems.size(); ++member) {
    const LinearSystem& own = *systems[member];
    braked_[member] = own.inverse_mass == scene.inverse_mass &&
                      own.lumped_mass == scene.lumped_mass &&
                      interactions::dashpot_rows(own) == dashpots;
  }
  if (std::ranges::none_of(braked_, std::identity())) return;
  std::fill(braked_.begin() + systems.size(), braked_.end(), true);  // nothing moves in these
  dashpots_.emplace(interactions::DashpotModes(scene, *dashpots, time_step_));
  free_velocity_.resize(coordinates());
}

void BatchStep::brake(double share) {
  const std::span<BatchValue> velocity = structure_->waiting();
  std::ranges::copy(velocity, free_velocity_.begin());
  dashpots_->brake(share, state_->velocity, velocity);
  dashpot_loss_ = dashpots_->loss(state_->velocity, velocity);
  for (std::size_t member = 0; member < batch_size; ++member) {
    if (braked_[member]) continue;
    dashpot_loss_[member] = 0;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      velocity[i][member] = free_velocity_[i][member];
    }
  }
}

void BatchStep::step(double duration, const std::array<BatchValue, 3>& ground_acceleration,
                     std::span<const BatchValue> supports, std::span<const double> loads,
                     bool with_energies, bool with_forces) {
  ++steps_;
  const StepRequest<BatchValue> request{with_energies ? stiffness_velocity_.data() : nullptr,
                                        with_forces};
  const BatchValue* const velocity = state_->velocity.data();
  if (elements_ != nullptr) {
    stiffness::StoredForces store(stiffness_velocity_.data());
    if (with_energies) elements_->apply({velocity, velocity, {}}, store);
    structure_->begin(duration, ground_acceleration, request, supports, loads);
    elements_->apply({state_->displacement.data(), velocity, beta_}, *structure_);
    return;
  }
  multiply_diagonals(with_energies);
  structure_->begin(duration, ground_acceleration, request, supports, loads);
  structure_->receive(0, static_cast<LocalIndex>(coordinates()), force_.data());
  if (dashpots_) brake(duration / time_step_);
  structure_->complete();
}

void BatchStep::multiply_diagonals(bool with_energies) {
  extra_before_ = BatchValue{};
  const BatchValue beta = beta_;
  for (std::size_t i = 0; i < coordinates(); ++i) {
    const BatchValue& velocity = state_->velocity[i];
    force_[i] = stiffness_[i] * (state_->displacement[i] + beta * velocity);
    if (with_energies) stiffness_velocity_[i] = stiffness_[i] * velocity;
    if (extra_damping_.empty()) continue;
    state_->extra_force[i] = extra_damping_[i] * velocity;
    extra_before_ += velocity * state_->extra_force[i];
  }
}

BatchMember::BatchMember(BatchStep& batch, std::size_t member, StructureState& state)
    : SteppedRun(*batch.structure_, member, state), batch_(batch) {
  const auto put = [member](std::span<const double> values, std::vector<BatchValue>& to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i][member] = values[i];
  };
  put(state.displacement, batch.state_->displacement);
  put(state.velocity, batch.state_->velocity);
  for (std::size_t k = 0; k < state.filtered.size(); ++k) {
    put(state.filtered[k], batch.state_->filtered[k]);
  }
}

void BatchMember::take(const std::vector<BatchValue>& values, std::vector<double>& to) const {
  for (std::size_t i = 0; i < values.size(); ++i) to[i] = values[i][member_];
}

void BatchMember::take_asked(const std::vector<BatchValue>& values, std::vector<double>& to) const {
  if (batch_.elements_ == nullptr) return take(values, to);
  for (const LocalIndex i : watched_) to[i] = values[i][member_];
}

void BatchMember::watch(std::span<const LocalIndex> dofs, bool always) {
  SteppedRun::watch(dofs, always);
  watched_.insert(watched_.end(), dofs.begin(), dofs.end());
  std::ranges::sort(watched_);
  watched_.erase(std::ranges::unique(watched_).begin(), watched_.end());
}

const std::vector<double>& BatchMember::displacement() const {
  if (displacement_known_ != batch_.steps_) {
    take_asked(batch_.state_->displacement, state_.displacement);
    displacement_known_ = batch_.steps_;
  }
  return state_.displacement;
}

const std::vector<double>& BatchMember::velocity() const {
  if (velocity_known_ != batch_.steps_) {
    take_asked(batch_.state_->velocity, state_.velocity);
    velocity_known_ = batch_.steps_;
  }
  return state_.velocity;
}

void BatchMember::bring_state() const {
  if (state_known_ == batch_.steps_) return;
  take(batch_.state_->displacement, state_.displacement);
  take(batch_.state_->velocity, state_.velocity);
  displacement_known_ = velocity_known_ = state_known_ = batch_.steps_;
  for (std::size_t k = 0; k < state_.filtered.size(); ++k) {
    take(batch_.state_->filtered[k], state_.filtered[k]);
  }
}

std::span<const double> BatchMember::points(const Trace& trace) {
  const std::size_t count = trace.known().size();
  if (count == 0 || batch_.elements_ != nullptr) return {};
  points_.resize(count);
  batch_.points_.resize(count);
  if (batch_.points_known_ != batch_.steps_) {
    multiply_rows(trace.row(0).data(), count, batch_.coordinates(),
                  batch_.state_->displacement.data(), batch_.points_.data());
    batch_.points_known_ = batch_.steps_;
  }
  take(batch_.points_, points_);
  return points_;
}

void BatchMember::correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
                          std::span<const double> velocity) {
  for (std::size_t k = 0; k < dofs.size() && batch_.brakes(member_); ++k) {
    const std::size_t i = dofs[k];
    const double change = velocity[k] - batch_.state_->velocity[i][member_];
    const double loss = batch_.dashpots_->loss_rate(i)[member_] * change;
    batch_.dashpot_loss_[member_] += loss;
  }
  SteppedRun::correct(dofs, before, velocity);
  for (const LocalIndex i : dofs) {
    state_.displacement[i] = batch_.state_->displacement[i][member_];
    state_.velocity[i] = batch_.state_->velocity[i][member_];
  }
}

StepSums BatchMember::sums() const {
  StepSums total = step_.sums(member_);
  total.extra_damping_before = batch_.extra_before_[member_];
  total.link_loss = batch_.dashpot_loss_[member_];
  return total;
}

}  // namespace pounding
