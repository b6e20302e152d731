#include "driver/time_loop.h"

#include "common/error.h"
#include "common/parallel.h"
#include "driver/checkpoint_schedule.h"
#include "driver/stop_signal.h"

namespace pounding {

Solver::Parts solver_parts(MPI_Comm comm, const Scene& scene, const Model& model,
                           std::span<const Mesh> meshes, Profile& profile) {
  Solver::Parts parts{comm,
                      model.systems,
                      meshes,
                      &model.interface,
                      model.motion.get(),
                      scene.gap_tolerance * model.interface.model_size,
                      model.time_step,
                      {},
                      &profile,
                      scene.progress_interval,
                      scene.contacts,
                      model.supports.get(),
                      model.load_histories.get()};
  for (const Building& building : model.buildings) {
    parts.energy_margins.push_back(building.energy_margin);
  }
  return parts;
}

TimeLoop::TimeLoop(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile)
    : comm_(comm),
      scene_(scene),
      model_(model),
      profile_(profile),
      solver_(solver_parts(comm, scene, model, model.meshes, profile)) {}

double TimeLoop::measure(int steps) {
  MPI_Barrier(comm_);
  const double start = MPI_Wtime();
  for (int i = 0; i < steps; ++i) solver_.stepper().step(true, false);
  MPI_Barrier(comm_);
  const double seconds = (MPI_Wtime() - start) / steps;
  solver_.restart();
  return seconds;
}

int TimeLoop::run(const RunIdentity& identity, const SavedState* restart) {
  const StopSignal stop_signal;
  observers_.emplace(make_observers({comm_, scene_, model_, solver_}, profile_));
  Observers& observers = observers_->all;
  if (restart != nullptr) {
    solver_.stepper().load(*restart);
    for (const auto& observer : observers.list()) observer->load(*restart);
    first_step_ = step() + 1;
  }
  observers.start(solver_.stepper(), restart);
  CheckpointSchedule schedule(comm_, scene_.checkpoint_interval, scene_.checkpoint_steps,
                              first_step_);
  int signal = 0;
  for (std::int64_t n = first_step_; n <= model_.steps && signal == 0; ++n) {
    const StepNeeds needs = observers.before(solver_.stepper());
    solver_.stepper().step(needs.gaps, needs.energies, needs.forces);
    observers.after(solver_.stepper());
    const CheckpointSchedule::Decision decision = schedule.after_step(n);
    if (decision.write) {
      write_checkpoint(identity);
    } else if (decision.flush) {
      flush();
    }
    signal = decision.signal;
  }
  const ScopedTimer timer(profile_, Phase::output);
  const bool complete = step() >= model_.steps;
  for (const auto& observer : observers.list()) observer->finish(complete);
  return complete ? 0 : signal;
}

void TimeLoop::flush() {
  const ScopedTimer timer(profile_, Phase::output);
  for (const auto& observer : observers_->all.list()) observer->flush();
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
  for (const auto& observer : observers_->all.list()) observer->save(saved);
  pounding::write_checkpoint(comm_, scene_.output + "/checkpoint.h5", identity, model_.meshes,
                             model_.systems, saved);
}

void TimeLoop::fill(RunStatistics& statistics) const {
  statistics.complete = step() >= model_.steps;
  statistics.steps = step() + 1 - first_step_;
  for (const auto& observer : observers_->all.list()) observer->report(statistics);
  if (solver_.contact() != nullptr) {
    statistics.contact_rows = solver_.contact()->rows();
    statistics.coupled_rows = solver_.contact()->coupled_rows();
    statistics.interface_ranks = solver_.contact()->members();
    statistics.interface_looks = solver_.looks();
    MPI_Allreduce(MPI_IN_PLACE, &statistics.interface_looks, 1, MPI_INT64_T, MPI_MAX, comm_);
    statistics.complementarity_residual = solver_.contact()->largest_residual();
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
  double residual = statistics.complementarity_residual;
  MPI_Allreduce(MPI_IN_PLACE, &residual, 1, MPI_DOUBLE, MPI_MAX, comm_);
  statistics.complementarity_residual = residual;
  profile_.note_memory(Phase::step);
  statistics.phases = report_phases(comm_, profile_, model_.dofs());
}

}  // namespace pounding
