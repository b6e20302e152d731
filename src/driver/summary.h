#pragma once

#include <string>

#include "driver/model.h"
#include "driver/run_statistics.h"
#include "output/recorder.h"
#include "scene/scene.h"

namespace pounding {

/// `summary.json`: every number that the run printed, versions and resolved options. Rank 0 only.
void write_summary(const std::string& path, const Scene& scene, const std::string& resolved,
                   const Model& model, const RunStatistics& statistics, const Recorder& recorder,
                   int ranks);

}  // namespace pounding
