#pragma once

#include <optional>
#include <span>

#include "driver/model.h"
#include "driver/observers.h"
#include "driver/run_statistics.h"
#include "driver/solver.h"
#include "output/checkpoint.h"

namespace pounding {

/// Parts of the solver of a model; `meshes`: those of its structures.
Solver::Parts solver_parts(MPI_Comm comm, const Scene& scene, const Model& model,
                           std::span<const Mesh> meshes, Profile& profile);

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
  const ImpactCatalogue& impacts() const { return observers_->impacts.catalogue(); }
  const Recorder& recorder() const { return observers_->history; }
  /// The last step made.
  std::int64_t step() const { return solver_.stepper().state().step - 1; }
  /// After `run`: findings of the steps and of the observers, which write their tables. Collective.
  void fill(RunStatistics& statistics) const;

 private:
  void write_checkpoint(const RunIdentity& identity);
  void flush();

  MPI_Comm comm_;
  const Scene& scene_;
  const Model& model_;
  Profile& profile_;
  Solver solver_;
  std::optional<RunObservers> observers_;  ///< of the run
  std::int64_t first_step_ = 0;
};

}  // namespace pounding
