#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include <mpi.h>

#include "model/model.h"
#include "observers/impact_catalogue.h"
#include "observers/recorder.h"
#include "observers/run_statistics.h"
#include "scene/command_line.h"
#include "scene/scene_reader.h"

namespace pounding {

/// Numbers of a run by which the next one may be chosen, the same on every rank.
struct RunOutcome {
  double wall_time = 0;                      ///< of everything [s]
  std::size_t dofs = 0;                      ///< of the largest structure at full order
  std::optional<FidelityEstimate> fidelity;  ///< its channels on rank 0
};

/// Estimate of the error of a run that has come to its end. Collective.
using FidelityEstimator = std::function<FidelityEstimate(const Scene&, const Model&,
                                                         const ImpactCatalogue&, const Recorder&)>;

/// The whole job: builds the model, steps to the end time, writes the results; prints on rank 0.
/// `origin`: whence the options are; `estimator`: none where no error is asked for. Needs MPI,
/// PETSc and SLEPc initialised over `comm` = PETSC_COMM_WORLD. Throws UserError and DivergenceError
/// on every rank alike. Collective.
RunOutcome run_scene(MPI_Comm comm, ReadScene read, const SceneOrigin& origin,
                     const FidelityEstimator& estimator = {});

}  // namespace pounding
