#include "driver/time_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "common/error.h"
#include "common/parallel.h"
#include "driver/checkpoint_schedule.h"
#include "driver/field_plan.h"
#include "driver/stop_signal.h"
#include "driver/storeys.h"
#include "driver/terminal.h"
#include "driver/watchdog.h"

namespace pounding {
namespace {

/// Faces slide with the sway of their structures: looked at this often, a slide is seen [s].
constexpr double slide_interval = 1e-3;

std::vector<int> contacts_of(const interactions::Interface& interface) {
  std::vector<int> contacts;
  for (const interactions::Constraint& constraint : interface.constraints) {
    contacts.push_back(constraint.contact);
  }
  return contacts;
}

std::vector<std::array<double, 2>> places_of(const interactions::Interface& interface) {
  std::vector<std::array<double, 2>> places;
  for (const interactions::Constraint& constraint : interface.constraints) {
    places.push_back(constraint.place);
  }
  return places;
}

bool may_lift_off(const Scene& scene) {
  return std::ranges::any_of(scene.structures, [](const Structure& structure) {
    return std::ranges::any_of(structure.regions, &Region::compression_only);
  });
}

Solver::Parts solver_parts(MPI_Comm comm, const Scene& scene, const Model& model,
                           Profile& profile) {
  Solver::Parts parts{comm,
                      model.systems,
                      model.meshes,
                      &model.interface,
                      model.motion.get(),
                      scene.gap_tolerance * model.interface.model_size,
                      model.time_step,
                      {},
                      &profile,
                      scene.progress_interval,
                      scene.contacts,
                      model.supports.get()};
  for (const Building& building : model.buildings) {
    parts.energy_margins.push_back(building.energy_margin);
  }
  return parts;
}

}  // namespace

TimeLoop::TimeLoop(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile)
    : comm_(comm),
      scene_(scene),
      model_(model),
      profile_(profile),
      solver_(solver_parts(comm, scene, model, profile)),
      slides_(solver_.contact() != nullptr ? std::make_unique<interactions::SlideWatch>(
                                                 comm, model.interface, model.systems, model.meshes,
                                                 static_cast<int>(scene.contacts.size()))
                                           : nullptr),
      catalogue_(static_cast<int>(scene.contacts.size()), contacts_of(model.interface),
                 places_of(model.interface),
                 {scene.impact_merge_time, scene.force_window, model.time_step}),
      smallest_gaps_(scene.contacts.size(), 0.0),
      closings_(scene.contacts.size(), model.interface.constraints, model.start_gaps),
      slide_stride_(static_cast<std::int64_t>(std::max(1.0, slide_interval / model.time_step))),
      uplift_(may_lift_off(scene) ? std::make_unique<UpliftWatch>(comm, model.systems.size())
                                  : nullptr),
      energies_(model.systems.size()),
      energy_round_off_(model.systems.size()),
      ledger_(model.steps / scene.energy_interval + 2) {}

double TimeLoop::measure(int steps) {
  MPI_Barrier(comm_);
  const double start = MPI_Wtime();
  for (int i = 0; i < steps; ++i) solver_.stepper().step(true, false);
  MPI_Barrier(comm_);
  const double seconds = (MPI_Wtime() - start) / steps;
  solver_.restart();
  return seconds;
}

void TimeLoop::create_recorder(bool continued) {
  Recorder::Layout layout;
  layout.comm = comm_;
  layout.path = scene_.output + "/history.h5";
  if (continued) {
    layout.continued = std::filesystem::path(scene_.restart).replace_filename("history.h5");
  }
  layout.title = scene_.title;
  layout.probes = model_.probes;
  for (const Contact& contact : scene_.contacts) layout.contacts.push_back(contact.name);
  if (loops_) {
    layout.links = loops_->names();
    layout.my_links = loops_->mine();
  }
  layout.bases = model_.storey_bases;
  layout.storeys = find_storeys(comm_, scene_, model_);
  if (forces_) {
    layout.forces = forces_->recorded();
    layout.force_unit = forces_->unit();
  }
  layout.interface_root = solver_.contact() != nullptr ? solver_.contact()->root() : -1;
  const auto whole = [&](double count) {  // never more than the run has, nor than an int holds
    constexpr double most = std::numeric_limits<int>::max();
    return std::clamp(count, 1.0, std::min(static_cast<double>(model_.steps) + 1, most));
  };
  layout.stride = record_stride(scene_, model_);
  layout.time_step = model_.time_step;
  layout.peaks_start = scene_.spectra.start;
  const double records = scene_.gap_interval / (model_.time_step * layout.stride);
  gap_stride_ = layout.stride * static_cast<std::int64_t>(whole(records));
  recorder_ = std::make_unique<Recorder>(std::move(layout), model_.systems, model_.meshes);
}

int TimeLoop::run(const RunIdentity& identity, const SavedState* restart) {
  const StopSignal stop_signal;
  progress_ = std::make_unique<RunProgress>(is_watched(), scene_.progress_interval);
  if (!scene_.loops.empty()) loops_ = std::make_unique<Loops>(comm_, scene_, model_, solver_);
  if (!scene_.forces.empty()) {
    forces_ = std::make_unique<Forces>(comm_, scene_, model_);
    forces_->watch(solver_.stepper());
  }
  create_recorder(restart != nullptr);
  if (restart == nullptr) recorder_->begin(solver_.stepper().state());
  fields_ = make_field_writer(comm_, scene_, model_, solver_.contact(), restart != nullptr);
  if (restart != nullptr) load(*restart);
  CheckpointSchedule schedule(comm_, scene_.checkpoint_interval, scene_.checkpoint_steps,
                              first_step_);
  int signal = 0;
  const double start = MPI_Wtime();
  const std::int64_t shown_interval = std::max<std::int64_t>(1, model_.steps / 200);
  for (std::int64_t n = first_step_; n <= model_.steps && signal == 0; ++n) {
    const bool ledger = n > 0 && (n % scene_.energy_interval == 0 || n == model_.steps);
    const bool records = recorder_->due(n);
    if (records) recorder_->take_displacements(solver_.stepper().state());
    if (fields_ && fields_->due(n)) fields_->take_displacements(solver_.stepper().state());
    if (records && forces_) forces_->begin(solver_.stepper().state());
    watch_slides(n);
    solver_.stepper().step(records && n % gap_stride_ == 0, ledger, records && forces_);
    observe(n);
    if (fields_) observe_fields(n);
    if (ledger) close_ledger_line();
    if (n > 0 && n % shown_interval == 0) show_progress(start);
    const CheckpointSchedule::Decision decision = schedule.after_step(n);
    if (decision.write) {
      write_checkpoint(identity);
    } else if (decision.flush) {
      flush();
    }
    signal = decision.signal;
  }
  const ScopedTimer timer(profile_, Phase::output);
  recorder_->finish(step() >= model_.steps);
  if (fields_) fields_->finish();
  catalogue_.finish(comm_, solver_.contact() != nullptr ? solver_.contact()->root() : 0);
  return step() < model_.steps ? signal : 0;
}

void TimeLoop::observe(std::int64_t step) {
  const ScopedTimer timer(profile_, Phase::output);
  std::array<double, 3> ground_step = solver_.stepper().ground_acceleration();
  for (double& value : ground_step) value *= solver_.stepper().force_duration();
  recorder_->add_step(ground_step);
  const bool reports = solver_.interface_known() && solver_.contact()->root() == rank_of(comm_);
  if (reports && solver_.touching()) {
    const interactions::ContactProblem& contact = *solver_.contact();
    ContactStep impulses{contact.gaps(), contact.impulses(), contact.works(), {}, {}, {}};
    if (contact.friction().has_any()) {
      impulses.tangential_impulses = contact.friction().tangential_impulses();
      impulses.slip_rates = contact.friction().slip_rates();
      impulses.friction_losses = contact.friction().losses();
    }
    catalogue_.add_step(solver_.stepper().time(), solver_.stepper().force_duration(), impulses);
    for (std::size_t row = 0; row < contact.impulses().size(); ++row) {
      recorder_->add_impulse(model_.interface.constraints[row].contact, contact.impulses()[row]);
    }
  }
  if (!recorder_->due(step)) return;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double none = std::numeric_limits<double>::max();
  std::fill(smallest_gaps_.begin(), smallest_gaps_.end(), reports ? none : unknown);
  if (reports) {
    closings_.look(solver_.contact()->gaps());
    for (std::size_t row = 0; row < solver_.contact()->gaps().size(); ++row) {
      double& gap = smallest_gaps_[model_.interface.constraints[row].contact];
      gap = std::min(gap, solver_.contact()->gaps()[row]);
    }
  }
  if (forces_) forces_->end(solver_);
  recorder_->record(solver_.stepper().state(), smallest_gaps_,
                    loops_ ? loops_->values() : std::span<const double>(),
                    forces_ ? forces_->values() : std::span<const double>());
}

void TimeLoop::observe_fields(std::int64_t step) {
  const ScopedTimer timer(profile_, Phase::output);
  if (solver_.touching() && fields_->counts(step)) {
    solver_.contact()->add_dof_impulses(fields_->impulses());
  }
  if (fields_->due(step)) fields_->record(solver_.stepper().state());
}

void TimeLoop::flush() {
  const ScopedTimer timer(profile_, Phase::output);
  recorder_->flush();
  if (fields_) fields_->flush();
}

void TimeLoop::watch_slides(std::int64_t step) {
  if (!slides_ || !slides_->member() || step % slide_stride_ != 0) return;
  const ScopedTimer timer(profile_, Phase::output);
  const std::vector<StructureState>& structures = solver_.stepper().state().structures;
  for (std::size_t s = 0; s < structures.size(); ++s) {
    slides_->set_displacement(s, structures[s].displacement.data(),
                              solver_.stepper().state().supports.displacement);
  }
  slides_->look(static_cast<double>(step) * model_.time_step);
}

void TimeLoop::close_ledger_line() {
  const ScopedTimer timer(profile_, Phase::energy);
  EnergyBalance& energy = solver_.stepper().energy();
  const EnergyLine line = energy.line(energies_);
  energy.note(line);
  watch_divergence(model_, solver_.stepper().state(), line, energies_);
  watch_identity(model_, line, energies_, energy.largest_term());
  watch_passivity(line, energy.largest_term());
  watch_contact(comm_, solver_.contact(), line.time);
  for (std::size_t s = 0; s < energies_.size(); ++s) {
    energy_round_off_[s] = energy_round_off(model_, s, energies_[s]);
  }
  solver_.note_energies(energy.closed_steps() - 1, energies_, energy_round_off_);
  ledger_.add(line);
  if (uplift_) {
    const std::int64_t rest = step() % scene_.energy_interval;  // of the last line
    const std::int64_t steps = rest == 0 ? scene_.energy_interval : rest;
    uplift_->look(solver_, static_cast<double>(steps) * model_.time_step);
  }
}

void TimeLoop::write_checkpoint(const RunIdentity& identity) {
  const ScopedTimer timer(profile_, Phase::output);
  SavedState saved;
  solver_.stepper().save(saved);
  int finite = saved.dofs_are_finite() ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &finite, 1, MPI_INT, MPI_MIN, comm_);
  if (finite == 0) {
    throw DivergenceError("the run diverged: not a number at step " + std::to_string(step()) +
                          "; the checkpoint before is kept");
  }
  recorder_->save(saved);
  const bool root =
      rank_of(comm_) == (solver_.contact() != nullptr ? solver_.contact()->root() : 0);
  if (root) catalogue_.save(saved);
  if (root) closings_.save(saved);
  if (fields_) {
    fields_->save(saved, root);
    fields_->flush();
  }
  if (slides_ && slides_->root() == rank_of(comm_)) slides_->save(saved);
  if (rank_of(comm_) == 0) ledger_.save(saved);
  if (rank_of(comm_) == 0 && uplift_) uplift_->save(saved);
  if (rank_of(comm_) == 0 && forces_) forces_->save(saved);
  pounding::write_checkpoint(comm_, scene_.output + "/checkpoint.h5", identity, model_.meshes,
                             model_.systems, saved);
}

void TimeLoop::load(const SavedState& saved) {
  solver_.stepper().load(saved);
  catalogue_.load(saved);
  closings_.load(saved);
  if (slides_) slides_->load(saved);
  ledger_.load(saved);
  if (uplift_) uplift_->load(saved);
  if (forces_) forces_->load(saved, solver_.stepper().time());
  if (fields_) fields_->check(saved);
  recorder_->load(saved);  // late: it replaces the history, which nothing refused may touch
  if (fields_) fields_->load();
  first_step_ = step() + 1;
}

void TimeLoop::show_progress(double start) {
  const double no_gap = std::numeric_limits<double>::max();
  std::array<double, 2> now{no_gap, 0};  // smallest gap, minus the number of impacts
  if (solver_.contact() != nullptr && solver_.contact()->root() == rank_of(comm_)) {
    now = {solver_.contact()->smallest_gap(), -static_cast<double>(catalogue_.episodes())};
  }
  MPI_Allreduce(MPI_IN_PLACE, now.data(), 2, MPI_DOUBLE, MPI_MIN, comm_);
  if (rank_of(comm_) != 0) return;
  const double time = solver_.stepper().time();
  const double begun =
      static_cast<double>(std::max<std::int64_t>(first_step_ - 1, 0)) * model_.time_step;
  progress_->show({time, scene_.end_time, time - begun, MPI_Wtime() - start, now[0],
                   std::llround(-now[1]), solver_.stepper().energy().relative_residual()});
}

void TimeLoop::fill(RunStatistics& statistics) const {
  statistics.steps = step() + 1 - first_step_;
  statistics.energy = ledger_.last();
  statistics.energy_residual = solver_.stepper().energy().relative_residual();
  if (solver_.contact() != nullptr) {
    statistics.contact_rows = solver_.contact()->rows();
    statistics.coupled_rows = solver_.contact()->coupled_rows();
    statistics.interface_ranks = solver_.contact()->members();
    statistics.interface_looks = solver_.looks();
    MPI_Allreduce(MPI_IN_PLACE, &statistics.interface_looks, 1, MPI_INT64_T, MPI_MAX, comm_);
    statistics.complementarity_residual = solver_.contact()->largest_residual();
    statistics.slides = slides_->slides();
    broadcast_array(comm_, statistics.slides, slides_->root());
    statistics.closings = closings_.closings();
    broadcast_array(comm_, statistics.closings, solver_.contact()->root());
  }
  if (solver_.fillers() != nullptr) {
    statistics.fillers = solver_.fillers()->totals();
    broadcast_array(comm_, statistics.fillers, solver_.fillers()->pairs().rows().root());
  }
  for (std::size_t s = 0; s < model_.systems.size(); ++s) {
    const interactions::StructureLinks* const links = solver_.links(s);
    int overpressed = links != nullptr && links->overpressed() ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &overpressed, 1, MPI_INT, MPI_MAX, comm_);
    if (overpressed != 0) statistics.overpressed.push_back(model_.systems[s].name);
  }
  if (loops_) statistics.loops = loops_->report();
  if (forces_) statistics.forces = forces_->report();
  if (uplift_) statistics.contact_ratios = uplift_->ratios();
  double residual = statistics.complementarity_residual;
  MPI_Allreduce(MPI_IN_PLACE, &residual, 1, MPI_DOUBLE, MPI_MAX, comm_);
  statistics.complementarity_residual = residual;
  for (std::size_t c = 0; c < scene_.contacts.size(); ++c) {
    statistics.impacts.push_back(catalogue_.totals(static_cast<int>(c)));
  }
  statistics.all_impacts = catalogue_.totals();
  profile_.note_memory(Phase::step);
  statistics.phases = report_phases(comm_, profile_, model_.dofs());
}

}  // namespace pounding
