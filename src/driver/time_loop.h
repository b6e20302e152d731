#pragma once

#include <memory>
#include <vector>

#include "driver/closing_watch.h"
#include "driver/forces.h"
#include "driver/loops.h"
#include "driver/model.h"
#include "driver/run_progress.h"
#include "driver/run_statistics.h"
#include "driver/solver.h"
#include "driver/uplift_watch.h"
#include "interactions/slide_watch.h"
#include "output/checkpoint.h"
#include "output/energy_ledger.h"
#include "output/field_writer.h"
#include "output/impact_catalogue.h"
#include "output/recorder.h"

namespace pounding {

/// Steps the model and feeds recorder, catalogue and ledger.
class TimeLoop {
 public:
  /// `model` and `profile` must outlive this object. Collective.
  TimeLoop(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile);

  /// Mean wall time of a step [s], measured on `steps` of them, nothing recorded; the loop stands
  /// at t_0 after it as before. Collective.
  double measure(int steps);
  /// Runs from t_0, or from after the step of `restart` unless it is null, to the end time;
  /// histories and checkpoints, which carry `identity`, into the scene's output folder. Returns 0,
  /// or the signal that stopped the run after a checkpoint. Throws DivergenceError, UserError.
  /// Collective.
  int run(const RunIdentity& identity, const SavedState* restart);

  const ImpactCatalogue& impacts() const { return catalogue_; }
  /// The last step made.
  std::int64_t step() const { return solver_.stepper().state().step - 1; }
  const EnergyLedger& ledger() const { return ledger_; }
  Recorder& recorder() { return *recorder_; }
  void fill(RunStatistics& statistics) const;

 private:
  void create_recorder(bool continued);
  void load(const SavedState& saved);
  void write_checkpoint(const RunIdentity& identity);
  void observe(std::int64_t step);
  /// Impulses of the step for the fields, and the frame where one is due.
  void observe_fields(std::int64_t step);
  /// Brings what is recorded to the files.
  void flush();
  /// Looks at how far the faces have slid, before the step to t_n.
  void watch_slides(std::int64_t step);
  void close_ledger_line();
  void show_progress(double start);

  MPI_Comm comm_;
  const Scene& scene_;
  const Model& model_;
  Profile& profile_;
  Solver solver_;
  std::unique_ptr<interactions::SlideWatch> slides_;  ///< null without contacts
  ImpactCatalogue catalogue_;
  std::unique_ptr<Loops> loops_;    ///< null if no link is recorded
  std::unique_ptr<Forces> forces_;  ///< null if none is recorded
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<FieldWriter> fields_;  ///< null if none are asked for
  std::vector<double> smallest_gaps_;    ///< per contact
  ClosingWatch closings_;
  std::int64_t gap_stride_ = 1;          ///< steps between two samples of the gaps
  std::int64_t slide_stride_ = 1;        ///< steps between two looks at the slides
  std::unique_ptr<UpliftWatch> uplift_;  ///< null where nothing may lift off
  std::vector<StructureEnergy> energies_;
  std::vector<double> energy_round_off_;  ///< of each of them [J]
  EnergyLedger ledger_;
  std::int64_t first_step_ = 0;
  std::unique_ptr<RunProgress> progress_;
};

}  // namespace pounding
