#include "driver/time_loop.h"

#include <algorithm>
#include <cstring>

#include "common/error.h"
#include "common/parallel.h"
#include "observers/kinds.h"

namespace pounding {
namespace {

/// Wall time between two agreements [s].
constexpr double agreement_interval = 0.05;

/// Wall time after which records go to the file [s].
constexpr double flush_interval = 10;

volatile sig_atomic_t received_signal = 0;

void remember(int signal) {
  received_signal = signal;
}

}  // namespace

TimeLoop::TimeLoop(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile)
    : comm_(comm),
      scene_(scene),
      model_(model),
      profile_(profile),
      scheme_(scheme_parts(comm, scene, model, model.meshes, profile)) {}

double TimeLoop::measure(int steps) {
  MPI_Barrier(comm_);
  const double start = MPI_Wtime();
  for (int i = 0; i < steps; ++i) scheme_.stepper().step(true, false);
  MPI_Barrier(comm_);
  const double seconds = (MPI_Wtime() - start) / steps;
  scheme_.restart();
  return seconds;
}

int TimeLoop::run(const RunIdentity& identity, const SavedState* restart) {
  const StopSignal stop_signal;
  observers_.emplace(make_observers({comm_, scene_, model_, scheme_}, profile_));
  Observers& observers = *observers_;
  if (restart != nullptr) {
    scheme_.stepper().keep(StateKeeper::from(*restart));
    for (const auto& observer : observers.list()) observer->keep_state(StateKeeper::from(*restart));
    first_step_ = step() + 1;
  }
  observers.start(scheme_.stepper(), restart);
  CheckpointSchedule schedule(comm_, scene_.checkpoint_interval, scene_.checkpoint_steps,
                              first_step_);
  int signal = 0;
  for (std::int64_t n = first_step_; n <= model_.steps && signal == 0; ++n) {
    const StepNeeds needs = observers.before(scheme_.stepper());
    scheme_.stepper().step(needs.gaps, needs.energies, needs.forces);
    observers.after(scheme_.stepper());
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
  for (const auto& observer : observers_->list()) observer->flush();
}

void TimeLoop::write_checkpoint(const RunIdentity& identity) {
  const ScopedTimer timer(profile_, Phase::output);
  SavedState saved;
  scheme_.stepper().keep(StateKeeper::to(saved));
  if (on_any_rank(comm_, !saved.dofs_are_finite())) {
    throw DivergenceError("the run diverged: not a number at step " + std::to_string(step()) +
                          "; the checkpoint before is kept");
  }
  for (const auto& observer : observers_->list()) observer->keep_state(StateKeeper::to(saved));
  pounding::write_checkpoint(comm_, scene_.output + "/checkpoint.h5", identity, model_.meshes,
                             model_.systems, saved);
}

void TimeLoop::fill(RunStatistics& statistics) const {
  statistics.complete = step() >= model_.steps;
  statistics.steps = step() + 1 - first_step_;
  for (const auto& observer : observers_->list()) observer->report(statistics);
  if (const CdLagrange::Order& order = scheme_.stepper().order(); order.least > 0) {
    const double share = static_cast<double>(order.steps) / static_cast<double>(step() + 1);
    statistics.findings.add("in_modes", {{"share", share}, {"left", order.left}},
                            "  in modes for {in_modes/share:.1f %} of the steps, which were left "
                            "{in_modes/left} times\n");
  }
  if (scheme_.contact() != nullptr) {
    statistics.contact_rows = scheme_.contact()->rows();
    statistics.coupled_rows = scheme_.contact()->coupled_rows();
    statistics.interface_ranks = scheme_.contact()->members();
    statistics.interface_looks = scheme_.looks();
    reduce_over_ranks(comm_, MPI_MAX, statistics.interface_looks);
    statistics.complementarity_residual = scheme_.contact()->largest_residual();
  }
  if (scheme_.fillers() != nullptr) {
    statistics.fillers = scheme_.fillers()->totals();
    broadcast_values(comm_, scheme_.fillers()->pairs().rows().root(), statistics.fillers);
  }
  for (std::size_t s = 0; s < model_.systems.size(); ++s) {
    const interactions::StructureLinks* const links = scheme_.links(s);
    const bool overpressed = links != nullptr && links->overpressed();
    if (on_any_rank(comm_, overpressed)) statistics.overpressed.push_back(model_.systems[s].name);
  }
  reduce_over_ranks(comm_, MPI_MAX, statistics.complementarity_residual);
  profile_.note_memory(Phase::step);
  statistics.phases = report_phases(comm_, profile_, model_.dofs());
}

CheckpointSchedule::CheckpointSchedule(MPI_Comm comm, double interval, std::int64_t steps,
                                       std::int64_t first_step)
    : comm_(comm),
      interval_(interval),
      steps_(steps),
      last_write_(MPI_Wtime()),
      last_flush_(last_write_),
      last_agreement_(last_write_),
      agreement_step_(first_step - 1),
      next_agreement_(first_step) {}

CheckpointSchedule::Decision CheckpointSchedule::after_step(std::int64_t n) {
  Decision decision;
  if (n >= next_agreement_) decision = agree(n);
  if (steps_ > 0 && n > 0 && n % steps_ == 0) decision.write = true;
  if (decision.write) last_write_ = MPI_Wtime();
  return decision;
}

CheckpointSchedule::Decision CheckpointSchedule::agree(std::int64_t n) {
  const double now = MPI_Wtime();
  // Signal, write a checkpoint, steps to the next agreement, flush.
  std::array<std::int64_t, 4> votes{StopSignal::received(), 0, 0, 0};
  if (rank_of(comm_) == 0) {
    // Limits the wait to twice the steps of last time: a few fast steps do not speak for those to
    // come.
    const auto done = static_cast<double>(n - agreement_step_);
    const double wanted = done * agreement_interval / std::max(now - last_agreement_, 1e-9);
    votes[1] = interval_ > 0 && now - last_write_ >= interval_ ? 1 : 0;
    votes[3] = now - last_flush_ >= flush_interval ? 1 : 0;
    votes[2] = static_cast<std::int64_t>(std::clamp(wanted, 1.0, 2 * done));
  }
  reduce_over_ranks(comm_, MPI_MAX, votes);
  last_agreement_ = now;
  agreement_step_ = n;
  next_agreement_ = n + votes[2];
  last_flush_ = votes[3] != 0 ? now : last_flush_;
  return {votes[0] != 0 || votes[1] != 0, votes[3] != 0, static_cast<int>(votes[0])};
}

StopSignal::StopSignal() {
  received_signal = 0;
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    sigaction(signals[i], nullptr, &before_[i]);
    if (signals[i] != SIGHUP || before_[i].sa_handler != SIG_IGN) {
      sigaction(signals[i], &action, nullptr);
    }
  }
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
}

int StopSignal::received() {
  return received_signal;
}

std::string signal_name(int signal) {
  return std::string("SIG") + sigabbrev_np(signal);
}

}  // namespace pounding
