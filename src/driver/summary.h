#pragma once

#include <string>

#include "driver/model.h"
#include "driver/provenance.h"
#include "driver/run_statistics.h"
#include "output/recorder.h"
#include "scene/scene.h"

namespace pounding {

/// A run at its end.
struct FinishedRun {
  const Provenance& provenance;
  const Scene& scene;
  const std::string& resolved;  ///< options in force
  const Model& model;
  const RunStatistics& statistics;
  const Recorder& recorder;
  int ranks = 1;
};

/// `summary.json`: every number that the run printed, whence it is, and resolved options. Throws
/// UserError if it cannot be written. Rank 0 only.
void write_summary(const std::string& path, const FinishedRun& run);

}  // namespace pounding
