#include "driver/time_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>
#include <unistd.h>

#include "common/error.h"
#include "common/parallel.h"
#include "driver/watchdog.h"

namespace pounding {
namespace {

/// Lines of the energy ledger that are kept at most.
constexpr std::int64_t ledger_capacity = 5000;

std::vector<int> contacts_of(const Interface& interface) {
  std::vector<int> contacts;
  for (const Constraint& constraint : interface.constraints) {
    contacts.push_back(constraint.contact);
  }
  return contacts;
}

std::vector<std::array<double, 2>> places_of(const Interface& interface) {
  std::vector<std::array<double, 2>> places;
  for (const Constraint& constraint : interface.constraints) {
    places.push_back(constraint.place);
  }
  return places;
}

std::unique_ptr<ContactProblem> make_contact(MPI_Comm comm, const Scene& scene,
                                             const Model& model) {
  if (model.interface.constraints.empty()) {
    return nullptr;
  }
  return std::make_unique<ContactProblem>(comm, model.interface, model.systems, model.meshes,
                                          scene.gap_tolerance * model.interface.model_size);
}

GapWatch make_watch(const Model& model, const ContactProblem* contact) {
  std::vector<double> norms;
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    norms.push_back(contact == nullptr ? 0 : contact->rate_norm(static_cast<int>(s)));
  }
  // The three components may peak together.
  const double peak = std::sqrt(3.0) * model.motion->peak_acceleration();
  return {model.systems, model.energy_margin, norms, peak, model.time_step};
}

}  // namespace

TimeLoop::TimeLoop(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile)
    : comm_(comm),
      scene_(scene),
      model_(model),
      profile_(profile),
      contact_(make_contact(comm, scene, model)),
      catalogue_(static_cast<int>(scene.contacts.size()), contacts_of(model.interface),
                 places_of(model.interface), scene.impact_merge_time),
      smallest_gaps_(scene.contacts.size(), 0.0),
      energies_(model.systems.size()) {
  stepper_ =
      std::make_unique<CdLagrange>(comm, model.systems, *model.motion, contact_.get(),
                                   make_watch(model, contact_.get()), model.time_step, profile);
  const std::int64_t lines = model.steps / scene.energy_interval + 2;
  ledger_stride_ = (lines + ledger_capacity - 1) / ledger_capacity;
  ledger_.reserve(static_cast<std::size_t>(lines / ledger_stride_ + 2));
}

double TimeLoop::measure(int steps) {
  MPI_Barrier(comm_);
  const double start = MPI_Wtime();
  for (int i = 0; i < steps; ++i) {
    stepper_->step(true, false);
  }
  MPI_Barrier(comm_);
  return (MPI_Wtime() - start) / steps;
}

void TimeLoop::create_recorder() {
  Recorder::Layout layout;
  layout.comm = comm_;
  layout.path = scene_.output + "/history.h5";
  layout.title = scene_.title;
  layout.probes = model_.probes;
  for (const Contact& contact : scene_.contacts) {
    layout.contacts.push_back(contact.name);
  }
  layout.interface_root = contact_ ? contact_->root() : -1;
  layout.stride = std::max(1, static_cast<int>(scene_.output_interval / model_.time_step));
  layout.time_step = model_.time_step;
  for (const LinearSystem& system : model_.systems) {
    layout.initial_velocity.push_back(system.initial_velocity);
  }
  recorder_ = std::make_unique<Recorder>(std::move(layout), model_.meshes);
}

void TimeLoop::run() {
  create_recorder();
  const double start = MPI_Wtime();
  const std::int64_t progress_interval = std::max<std::int64_t>(1, model_.steps / 200);
  for (std::int64_t n = 0; n <= model_.steps; ++n) {
    const bool ledger = n > 0 && (n % scene_.energy_interval == 0 || n == model_.steps);
    if (recorder_->due(n)) {
      recorder_->take_displacements(stepper_->state());
    }
    stepper_->step(recorder_->due(n), ledger);
    observe(n);
    if (ledger) {
      close_ledger_line();
    }
    if (n > 0 && n % progress_interval == 0) {
      show_progress(start);
    }
  }
  const ScopedTimer timer(profile_, Phase::output);
  recorder_->finish();
  catalogue_.finish(comm_, contact_ ? contact_->root() : 0);
}

void TimeLoop::observe(std::int64_t step) {
  const ScopedTimer timer(profile_, Phase::output);
  std::array<double, 3> ground_step = stepper_->ground_acceleration();
  for (double& value : ground_step) {
    value *= stepper_->force_duration();
  }
  recorder_->add_step(ground_step);
  const bool reports = stepper_->interface_known() && contact_->root() == rank_of(comm_);
  if (reports && stepper_->touching()) {
    catalogue_.add_step(stepper_->time(), stepper_->force_duration(), contact_->gaps(),
                        contact_->impulses(), contact_->works());
    for (std::size_t row = 0; row < contact_->impulses().size(); ++row) {
      recorder_->add_impulse(model_.interface.constraints[row].contact, contact_->impulses()[row]);
    }
  }
  if (!recorder_->due(step)) {
    return;
  }
  if (reports) {
    std::fill(smallest_gaps_.begin(), smallest_gaps_.end(), std::numeric_limits<double>::max());
    for (std::size_t row = 0; row < contact_->gaps().size(); ++row) {
      double& gap =
          smallest_gaps_[static_cast<std::size_t>(model_.interface.constraints[row].contact)];
      gap = std::min(gap, contact_->gaps()[row]);
    }
  }
  recorder_->record(stepper_->state(), smallest_gaps_);
}

void TimeLoop::close_ledger_line() {
  const ScopedTimer timer(profile_, Phase::energy);
  EnergyBalance& energy = stepper_->energy();
  last_line_ = energy.line(energies_);
  energy.note(last_line_);
  watch_divergence(model_, stepper_->state(), last_line_, energies_);
  watch_identity(last_line_, energy.relative_residual());
  stepper_->gap_watch().energies_known(energy.closed_steps() - 1, energies_);
  if (rank_of(comm_) == 0 && ledger_lines_ % ledger_stride_ == 0) {
    ledger_.push_back(last_line_);
  }
  ++ledger_lines_;
}

void TimeLoop::show_progress(double start) {
  const double no_gap = std::numeric_limits<double>::max();
  std::array<double, 2> now{no_gap, 0};  // smallest gap, minus the number of impacts
  if (contact_ && contact_->root() == rank_of(comm_)) {
    now = {contact_->smallest_gap(), -static_cast<double>(catalogue_.episodes())};
  }
  MPI_Allreduce(MPI_IN_PLACE, now.data(), 2, MPI_DOUBLE, MPI_MIN, comm_);
  if (rank_of(comm_) != 0 || isatty(STDOUT_FILENO) == 0) {
    return;
  }
  const double elapsed = MPI_Wtime() - start;
  const double time = stepper_->time();
  const double fraction = time / scene_.end_time;
  std::printf("\r  %5.1f %%  t = %.3f s  %.3f s/s  remaining %.0f s", 100 * fraction, time,
              elapsed / time, elapsed * (1 / fraction - 1));
  if (now[0] < no_gap) {
    std::printf("  gap %.2f mm  impacts %.0f", 1000 * now[0], std::abs(now[1]));
  }
  std::printf("  energy residual %.1e   ", stepper_->energy().relative_residual());
  std::fflush(stdout);
}

void TimeLoop::fill(RunStatistics& statistics) const {
  statistics.energy = last_line_;
  statistics.energy_residual = stepper_->energy().relative_residual();
  if (contact_) {
    statistics.contact_rows = contact_->rows();
    statistics.coupled_rows = contact_->coupled_rows();
    statistics.interface_ranks = contact_->members();
    statistics.complementarity_residual = contact_->largest_residual();
  }
  double residual = statistics.complementarity_residual;
  MPI_Allreduce(MPI_IN_PLACE, &residual, 1, MPI_DOUBLE, MPI_MAX, comm_);
  statistics.complementarity_residual = residual;
  for (std::size_t c = 0; c < scene_.contacts.size(); ++c) {
    statistics.impacts.push_back(catalogue_.totals(static_cast<int>(c)));
  }
  statistics.all_impacts = catalogue_.totals();
  for (int phase = 0; phase < static_cast<int>(Phase::count); ++phase) {
    double seconds = profile_.seconds(static_cast<Phase>(phase));
    MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, comm_);
    statistics.phase_seconds.push_back(seconds);
  }
}

}  // namespace pounding
