#include "ensemble/member_run.h"

#include <algorithm>
#include <limits>

#include "driver/gap_bounds.h"
#include "driver/impact_watch.h"
#include "driver/watchdog.h"
#include "dynamics/structure_step.h"

namespace pounding {
namespace {

std::unique_ptr<interactions::ContactProblem> make_contact(const Model& model, const Model& shared,
                                                           double tolerance) {
  if (model.interface.constraints.empty()) return nullptr;
  return std::make_unique<interactions::ContactProblem>(MPI_COMM_SELF, model.interface,
                                                        model.systems, shared.meshes,
                                                        tolerance * model.interface.model_size);
}

std::unique_ptr<GapWatch> make_watch(const Model& model,
                                     const interactions::ContactProblem* contact) {
  std::vector<double> margins;
  for (const Building& building : model.buildings) margins.push_back(building.energy_margin);
  return std::make_unique<GapWatch>(
      model.systems,
      gap_bounds(MPI_COMM_SELF, model.systems, margins, model.time_step, contact,
                 std::numeric_limits<double>::infinity()),
      model.motion->peaks(), model.time_step);
}

}  // namespace

MemberRun::MemberRun(const MemberScene& member, const EnsembleModel& shared, std::size_t lane)
    : lane_(lane),
      model_(member_model(member, shared)),
      contact_(make_contact(model_, *shared.model, member.scene.gap_tolerance)),
      watch_(make_watch(model_, contact_.get())),
      energy_(MPI_COMM_SELF, model_.systems, model_.time_step),
      catalogue_(make_catalogue(member.scene, model_)),
      state_(model_.systems),
      sums_(model_.systems.size()),
      smallest_gaps_(member.scene.contacts.size(), std::numeric_limits<double>::infinity()) {
  for (std::size_t s = 0; s < model_.systems.size(); ++s) {
    const LinearSystem& system = model_.systems[s];
    start_filters(system, model_.time_step, state_.structures[s]);
    const std::size_t size = system.lumped_mass.size();
    before_.emplace_back(size);
    velocity_.emplace_back(size, 0.0);
  }
}

const std::array<double, 3>& MemberRun::begin(double time) {
  model_.motion->evaluate(time, acceleration_);
  return acceleration_;
}

std::span<const double> MemberRun::interface_rows(std::size_t structure) const {
  if (!contact_) return {};
  const Trace& trace = contact_->trace(structure);
  if (trace.known().empty()) return {};
  return {trace.row(0).data(), trace.known().size() * trace.dofs().size()};
}

void MemberRun::look(std::int64_t step, std::span<const std::vector<Octet>> places,
                     std::span<const OctetStep> steps, std::span<const OctetState> states) {
  touching_ = false;
  known_ = contact_ && (!places.empty() || watch_->due(step));
  if (!known_) return;
  ++looks_;
  for (std::size_t s = 0; s < states.size(); ++s) set_displacement(s, places, states[s]);
  contact_->gather_displacements();
  touching_ = contact_->detect_contact();
  for (std::size_t s = 0; touching_ && s < states.size(); ++s) {
    steps[s].remember(states[s], lane_, before_[s]);
    contact_->set_velocity_before(s, before_[s].velocity.data());
  }
  if (!touching_) {
    contact_->clear_impulse();
    if (!watch_->needs_look(step)) return;
    if (watch_->measures()) measure(states);
  }
  watch_->looked(step, contact_->smallest_gap() - contact_->gap_tolerance(), touching_);
}

void MemberRun::set_displacement(std::size_t structure, std::span<const std::vector<Octet>> places,
                                 const OctetState& state) {
  if (places.empty()) {
    StructureState& own = state_.structures[structure];
    OctetState::take(state.displacement, lane_, own.displacement);
    contact_->set_displacement(structure, own.displacement.data());
  } else {
    places_.resize(places[structure].size());
    OctetState::take(places[structure], lane_, places_);
    contact_->set_place_displacement(structure, places_);
  }
}

void MemberRun::measure(std::span<const OctetState> states) {
  for (std::size_t s = 0; s < states.size(); ++s) {
    StructureState& own = state_.structures[s];
    OctetState::take(states[s].displacement, lane_, own.displacement);
    OctetState::take(states[s].velocity, lane_, own.velocity);
    for (std::size_t k = 0; k < own.filtered.size(); ++k) {
      OctetState::take(states[s].filtered[k], lane_, own.filtered[k]);
    }
  }
  watch_->measure(state_.structures);
}

void MemberRun::resolve(std::span<OctetStep> steps, std::span<OctetState> states) {
  if (!touching_) return;
  for (std::size_t s = 0; s < states.size(); ++s) {
    OctetState::take(states[s].velocity, lane_, velocity_[s]);
    contact_->set_free_velocity(s, velocity_[s].data());
  }
  contact_->gather_velocities();
  contact_->solve_impulse();
  for (std::size_t s = 0; s < states.size(); ++s) {
    contact_->add_velocity_change(s, velocity_[s].data());
    steps[s].correct(lane_, before_[s], velocity_[s], states[s]);
  }
}

void MemberRun::close(double time, double duration, bool records,
                      std::span<const OctetStep> steps) {
  for (std::size_t s = 0; s < steps.size(); ++s) sums_[s] = steps[s].sums(lane_);
  if (touching_) {
    sums_.front().contact_work = contact_->total_work();
    sums_.front().friction_loss = contact_->friction().total_loss();
  }
  energy_.add_step(sums_, acceleration_);
  if (touching_) add_contact(*contact_, time, duration, catalogue_);
  if (known_ && records) note_gaps();
}

void MemberRun::note_gaps() {
  for (std::size_t row = 0; row < contact_->gaps().size(); ++row) {
    double& gap = smallest_gaps_[model_.interface.constraints[row].contact];
    gap = std::min(gap, contact_->gaps()[row]);
  }
}

void MemberRun::close_ledger(std::int64_t step, std::span<const OctetState> states) {
  for (std::size_t s = 0; s < states.size(); ++s) {
    OctetState::take(states[s].velocity, lane_, state_.structures[s].velocity);
  }
  state_.step = step + 1;
  const ClosedLine closed = close_line(MPI_COMM_SELF, model_, state_, contact_.get(), energy_);
  watch_->energies_known(energy_.closed_steps() - 1, closed.energies, closed.round_off);
}

void MemberRun::fill(MemberResult& result) {
  catalogue_.finish(MPI_COMM_SELF, 0);
  result.smallest_gap = smallest_gaps_;
  result.energy_residual = {energy_.relative_residual()};
  if (contact_) result.contact_residual = {contact_->largest_residual()};
  result.first_time.assign(contacts(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < contacts(); ++c) {
    const ImpactTotals totals = catalogue_.totals(static_cast<int>(c));
    result.episodes.push_back(totals.episodes);
    result.impulse_sum.push_back(totals.total_impulse);
    result.impulse_largest.push_back(totals.largest_impulse);
    result.force_peak.push_back(totals.peak_force);
  }
  for (const Impact& impact : catalogue_.impacts()) {  // the earliest first
    double& first = result.first_time[impact.contact];
    if (!(first <= impact.start)) first = impact.start;
  }
}

}  // namespace pounding
