#include "dynamics/cd_lagrange.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "common/memory.h"
#include "common/parallel.h"

namespace pounding {
namespace {

/// Steps between two looks whether to go to modes, per coordinate. A look and the change back read
/// Phi some times, which costs about a quarter of these steps.
constexpr std::int64_t looks_apart = 8;

}  // namespace

CdLagrange::CdLagrange(MPI_Comm comm, std::span<const LinearSystem> systems,
                       const GroundMotion& motion, double time_step, Profile& profile,
                       const SupportMotion* supports, const LoadHistories* loads, BatchSlot slot)
    : comm_(comm),
      systems_(systems),
      motion_(motion),
      support_motion_(supports),
      loads_(loads),
      time_step_(time_step),
      profile_(profile),
      state_(systems, supports != nullptr ? supports->columns().size() : 0),
      supports_(state_.supports.displacement.size()),
      energy_(comm, systems, time_step),
      sums_(systems.size()),
      rest_before_(systems.size(), 0.0),
      load_values_(loads != nullptr ? loads->size() : 0, 0.0),
      incident_(motion.incident().size(), 0.0) {
  structure_steps_ = std::vector<std::optional<StructureStep<double>>>(systems_.size());
  runs_ = std::vector<std::optional<SteppedRun<double>>>(systems_.size());
  members_ = std::vector<std::optional<BatchMember>>(systems_.size());
  switched_.resize(systems_.size());
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    StructureState& state = state_.structures[s];
    start_filters(systems_[s], time_step, state);
    if (BatchStep* const batch = slot.of(s); batch != nullptr) {
      structures_.push_back(&members_[s].emplace(*batch, slot.number, state));
    } else if (systems_[s].switched) {
      StructureStep<double>& step =
          structure_steps_[s].emplace(std::array{&systems_[s]}, state, time_step);
      switched_[s] = std::make_unique<SwitchedRun>(systems_[s], s, step, state, energy_, time_step);
      structures_.push_back(switched_[s].get());
      order_.least = std::max(order_.least,
                              looks_apart * std::ssize(systems_[s].switched->system.lumped_mass));
    } else {
      structure_steps_[s].emplace(std::array{&systems_[s]}, state, time_step);
      structures_.push_back(&runs_[s].emplace(*structure_steps_[s], 0, state));
    }
    ledger_.push_back(&sums_[s]);
    vectors_.emplace_back(systems_[s], state);
    extra_forces_.push_back(systems_[s].has_extra_damping()
                                ? wrap_vector(systems_[s], state.extra_force)
                                : VecHandle());
    stiffness_velocity_.push_back(zeros_on_large_pages(members_[s] ? 0 : state.velocity.size()));
    rest_forces_.push_back(rest_forces(systems_[s]));
  }
  order_.next = order_.least;
}

CdLagrange::~CdLagrange() = default;

void CdLagrange::step(bool look_at_gap, bool with_energies, bool with_forces) {
  open(look_at_gap, with_energies);  // A = { i : g_i(u_n) <= g_tol }
  free_velocity(with_forces);        // v_free = v- + dt (g - iota a_g - alpha v-)
                                     //        - dt M^-1 (K (u_n + beta v-) + D v-)
  close();                           // v+ = v_free + M^-1 b^T lambda, u_{n+1} = u_n + dt v+
                                     // E+ - E- = -dt vbar^T C vbar + dt vbar^T f
                                     //           + what interactions held and lost
}

bool CdLagrange::open(bool look_at_gap, bool with_energies) {
  with_energies_ = with_energies || energy_.needs_energies();
  move_ground();
  const interactions::Step step = at_hand(look_at_gap);
  if (order_.least > 0 && !order_.modes && state_.step >= order_.next) try_modes();
  for (const auto& interaction : interactions_) interaction->begin(step);
  if (order_.modes && state_.step >= order_.next && is_struck()) {
    leave_modes();
    for (const auto& interaction : interactions_) interaction->begin(step);
  }
  if (order_.modes && corrects()) throw std::logic_error("an impulse where no gap could close");
  for (std::size_t s = 0; with_energies_ && s < systems_.size(); ++s) {
    if (const SwitchedRun* const run = in_modes(s)) rest_before_[s] = run->about_rest();
    if (in_modes(s) || rest_forces_[s].empty()) continue;
    structures_[s]->bring_state();
    rest_before_[s] = rest_work(rest_forces_[s], systems_[s], state_.structures[s], time_step_);
  }
  return with_energies_;
}

void CdLagrange::close() {
  const interactions::Step step = at_hand(false);
  for (const auto& interaction : interactions_) interaction->push(step);
  if (order_.modes) ++order_.steps;
  if (corrects()) order_.struck = state_.step;
  close_energy(step);
  for (auto* structure : structures_) {
    if (with_energies_) structure->bring_state();
  }
}

interactions::Step CdLagrange::at_hand(bool look_at_gap) const {
  return {state_.step, look_at_gap, incident_, profile_, supports_, structures_, ledger_};
}

void CdLagrange::move_ground() {
  force_duration_ = state_.step == 0 ? time_step_ / 2 : time_step_;
  const double time = static_cast<double>(state_.step) * time_step_;
  motion_.evaluate(time, acceleration_);
  if (motion_.from_below()) motion_.evaluate_incident(time, incident_);
  if (loads_ != nullptr) loads_->evaluate(time, load_values_);
  if (support_motion_ == nullptr) return;
  support_motion_->evaluate(time, supports_.acceleration);
  supports_.begin(state_.supports, force_duration_);
}

bool CdLagrange::corrects() const {
  return std::ranges::any_of(interactions_, &interactions::Interaction::corrects);
}

void CdLagrange::free_velocity(bool with_forces) {
  const ScopedEvent event(events_.free_velocity);
  const ScopedTimer timer(profile_, Phase::step);
  with_forces = with_forces || corrects();
  for (std::size_t s = 0; with_energies_ && s < systems_.size(); ++s) {
    if (!at_full_order(s)) continue;
    const double* const velocity = state_.structures[s].velocity.data();
    stiffness::StoredForces store(stiffness_velocity_[s].data());
    systems_[s].stiffness->apply({velocity, velocity, 0}, store);
  }
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    if (at_full_order(s)) systems_[s].stiffness->start(argument(s));
  }
  for (std::size_t s = 0; s < systems_.size(); ++s) {
    if (SwitchedRun* const run = in_modes(s)) {
      run->step(acceleration_, with_energies_, with_forces, supports_.acceleration, load_values_);
    }
    if (!at_full_order(s)) continue;
    sums_[s].extra_damping_before = apply_extra_damping(s);
    const double* const rate = with_energies_ ? stiffness_velocity_[s].data() : nullptr;
    structure_steps_[s]->begin(force_duration_, acceleration_, {rate, with_forces},
                               supports_.acceleration, load_values_);
    systems_[s].stiffness->finish(argument(s), *structure_steps_[s]);
    structure_steps_[s]->complete();
  }
}

void CdLagrange::close_energy(const interactions::Step& step) {
  const ScopedEvent event(events_.close_energy);
  for (std::size_t s = 0; s < sums_.size(); ++s) {
    const double extra_damping_before = sums_[s].extra_damping_before;
    sums_[s] = members_[s]   ? members_[s]->sums()
               : in_modes(s) ? switched_[s]->sums()
                             : structure_steps_[s]->sums(0);
    if (at_full_order(s)) sums_[s].extra_damping_before = extra_damping_before;
  }
  for (std::size_t s = 0; with_energies_ && s < sums_.size(); ++s) {
    sums_[s].rest_before = rest_before_[s];
  }
  for (const auto& interaction : interactions_) interaction->finish(step);
  energy_.add_step(sums_, acceleration_, with_energies_);
  if (support_motion_ != nullptr) supports_.finish(time_step_, state_.supports);
  ++state_.step;
}

SwitchedRun* CdLagrange::in_modes(std::size_t structure) const {
  return order_.modes ? switched_[structure].get() : nullptr;
}

void CdLagrange::try_modes() {
  std::int64_t struck = order_.struck;
  reduce_over_ranks(comm_, MPI_MAX, struck);
  const std::int64_t quiet = state_.step - struck;
  order_.next = state_.step + std::max(order_.least, quiet / 2);
  if (struck >= 0 && quiet < order_.least) order_.next = struck + order_.least;
  // Looks cost a sixteenth of the steps, and the time that those in modes spared.
  const bool affordable = order_.looks * order_.least <= state_.step / 4 + 4 * order_.steps;
  if (order_.next == struck + order_.least || !affordable) return;
  ++order_.looks;
  const auto fits = [](const auto& run) { return !run || run->fits_modes(); };
  if (!std::ranges::all_of(switched_, fits)) return;
  for (const auto& run : switched_) {
    if (run) run->enter_modes();
  }
  order_.modes = true;
  order_.next = state_.step;
}

bool CdLagrange::is_struck() {
  order_.next = std::numeric_limits<std::int64_t>::max();
  for (const auto& interaction : interactions_) {
    order_.next = std::min(order_.next, interaction->next_action());
  }
  reduce_over_ranks(comm_, MPI_MIN, order_.next);
  return order_.next <= state_.step;
}

void CdLagrange::leave_modes() {
  for (const auto& run : switched_) {
    if (run) run->leave_modes();
  }
  order_.modes = false;
  order_.next = state_.step + order_.least;
  ++order_.left;
}

void CdLagrange::keep(const StateKeeper& state) {
  const auto keep_runs = [&] {
    for (const auto& run : switched_) {
      if (run) run->keep(state);
    }
  };
  if (state.puts()) keep_runs();
  if (order_.least > 0) {
    reduce_over_ranks(comm_, MPI_MAX, order_.struck);
    state.numbers("order", order_.modes, order_.next, order_.struck, order_.looks, order_.steps,
                  order_.left);
  }
  state_.keep(state);
  energy_.keep(state);
  for (const auto& interaction : interactions_) interaction->keep(state);
  if (!state.puts()) keep_runs();
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
