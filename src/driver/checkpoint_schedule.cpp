#include "driver/checkpoint_schedule.h"

#include <algorithm>
#include <array>

#include "common/parallel.h"
#include "driver/stop_signal.h"

namespace pounding {
namespace {

/// Wall time between two agreements [s].
constexpr double agreement_interval = 0.05;

/// Wall time after which records go to the file [s].
constexpr double flush_interval = 10;

}  // namespace

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
  MPI_Allreduce(MPI_IN_PLACE, votes.data(), votes.size(), MPI_INT64_T, MPI_MAX, comm_);
  last_agreement_ = now;
  agreement_step_ = n;
  next_agreement_ = n + votes[2];
  last_flush_ = votes[3] != 0 ? now : last_flush_;
  return {votes[0] != 0 || votes[1] != 0, votes[3] != 0, static_cast<int>(votes[0])};
}

}  // namespace pounding
