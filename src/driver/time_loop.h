#pragma once

#include <memory>
#include <vector>

#include "driver/model.h"
#include "driver/run_statistics.h"
#include "dynamics/cd_lagrange.h"
#include "output/impact_catalogue.h"
#include "output/recorder.h"

namespace pounding {

/// Steps the model and feeds recorder, catalogue and ledger.
class TimeLoop {
 public:
  /// `model` and `profile` must outlive this object. Collective.
  TimeLoop(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile);

  /// Mean wall time of a step [s], measured on `steps` of them, nothing recorded. Collective.
  double measure(int steps);
  /// From t_0 to the end time; results into the scene's output folder. Throws DivergenceError.
  /// Collective.
  void run();

  const ImpactCatalogue& impacts() const { return catalogue_; }
  const std::vector<EnergyLine>& ledger() const { return ledger_; }
  Recorder& recorder() { return *recorder_; }
  void fill(RunStatistics& statistics) const;

 private:
  void create_recorder();
  void observe(std::int64_t step);
  void close_ledger_line();
  void show_progress(double start);

  MPI_Comm comm_;
  const Scene& scene_;
  const Model& model_;
  Profile& profile_;
  std::unique_ptr<ContactProblem> contact_;
  std::unique_ptr<CdLagrange> stepper_;
  ImpactCatalogue catalogue_;
  std::unique_ptr<Recorder> recorder_;
  std::vector<double> smallest_gaps_;  ///< per contact
  std::vector<StructureEnergy> energies_;
  std::vector<EnergyLine> ledger_;  ///< rank 0
  std::int64_t ledger_stride_ = 1;  ///< lines kept of those computed
  std::int64_t ledger_lines_ = 0;
  EnergyLine last_line_;
};

}  // namespace pounding
