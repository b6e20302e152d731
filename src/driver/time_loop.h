#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <signal.h>
#include <string>

#include <mpi.h>

#include "model/model.h"
#include "model/model_scheme.h"
#include "observers/run_statistics.h"
#include "output/checkpoint.h"

namespace pounding {

/// Steps the model under the eyes of its observers.
class TimeLoop {
 public:
  /// `model` and `profile` must outlive this object. Collective.
  TimeLoop(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile);

  /// Mean wall time of a step [s], measured on `steps` of them, nothing recorded; the loop is at
  /// t_0 after it as before. Collective.
  double measure(int steps);
  /// Runs from t_0, or from after the step of `restart` unless it is null, to the end time;
  /// histories and checkpoints, which carry `identity`, into the scene's output folder. Returns 0,
  /// or the signal that stopped the run after a checkpoint. Throws DivergenceError, UserError.
  /// Collective.
  int run(const RunIdentity& identity, const SavedState* restart);

  /// After `run`.
  const ImpactCatalogue& impacts() const { return observers_->impacts(); }
  const Recorder& recorder() const { return observers_->history(); }
  /// The last step made.
  std::int64_t step() const { return scheme_.stepper().state().step - 1; }
  /// After `run`: findings of the steps and of the observers, which write their tables. Collective.
  void fill(RunStatistics& statistics) const;

 private:
  void write_checkpoint(const RunIdentity& identity);
  void flush();

  MPI_Comm comm_;
  const Scene& scene_;
  const Model& model_;
  Profile& profile_;
  ModelScheme scheme_;
  std::optional<Observers> observers_;  ///< of the run
  std::int64_t first_step_ = 0;
};

/// When to write a checkpoint, when to bring the records to the file and when to stop, the same on
/// every rank. The ranks agree by one small reduction about twenty times per second of wall time,
/// not in every step.
class CheckpointSchedule {
 public:
  /// `interval`: wall time between checkpoints [s]; `steps`: steps between them; 0: none.
  /// `first_step`: the next step of the run.
  CheckpointSchedule(MPI_Comm comm, double interval, std::int64_t steps, std::int64_t first_step);

  struct Decision {
    bool write = false;
    bool flush = false;  ///< the records, every ten seconds of wall time
    int signal = 0;      ///< that stops the run, which writes as well; 0: go on
  };
  /// After step `n`. Collective.
  Decision after_step(std::int64_t n);

 private:
  Decision agree(std::int64_t n);

  MPI_Comm comm_;
  double interval_;
  std::int64_t steps_;
  double last_write_;            ///< wall time [s]
  double last_flush_;            ///< wall time [s]
  double last_agreement_;        ///< wall time [s]
  std::int64_t agreement_step_;  ///< of the last agreement
  std::int64_t next_agreement_;
};

/// While this object lives, SIGTERM, SIGINT, SIGHUP and SIGUSR1 are kept for the run to look at
/// instead of ending the program; SIGHUP only if the program does not ignore it. One at a time.
class StopSignal {
 public:
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  ~StopSignal();

  /// The signal that this rank received, 0: none.
  static int received();

 private:
  static constexpr std::array signals{SIGTERM, SIGINT, SIGHUP, SIGUSR1};
  std::array<struct sigaction, signals.size()> before_{};
};

/// "SIGTERM".
std::string signal_name(int signal);

}  // namespace pounding
