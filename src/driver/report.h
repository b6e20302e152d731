#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "driver/equipment_capacity.h"
#include "driver/floor_spectra.h"
#include "driver/model.h"
#include "driver/provenance.h"
#include "driver/run_statistics.h"
#include "output/impact_catalogue.h"
#include "output/recorder.h"
#include "scene/scene.h"

/// Report that a run prints, and its summary.json: both have the facts of the subjects (facts.h),
/// each in its order. For rank 0.
namespace pounding {

/// `overrides`: in words, how the run differs from the files of its options.
void print_title(const Scene& scene, const std::string& overrides, int ranks);
void print_model(const Scene& scene, const Model& model);
/// `seconds_per_step`: measured, 0 if it was not.
void print_time_step(const Scene& scene, const Model& model, double seconds_per_step);
/// `files`: those removed from the folder of results.
void print_removed(const Scene& scene, std::span<const std::string> files);
/// `step`: that of the checkpoint from which the run continues.
void print_restart(const Scene& scene, const Model& model, std::int64_t step);

/// A run at its end.
struct FinishedRun {
  const Provenance& provenance;
  const Scene& scene;
  const std::string& resolved;  ///< options in force
  const Model& model;
  const RunStatistics& statistics;
  const ImpactCatalogue& impacts;
  const Recorder& recorder;
  const std::vector<ProbeSpectrum>& spectra;
  const std::vector<TargetSpectrum>& capacities;  ///< of equipment, in the order of the scene
  int ranks = 1;
};

/// The doubts of a run once more, for its end: the first ones, and the number of all.
std::string doubts_again(std::initializer_list<std::span<const std::string>> lists);

void print_results(const FinishedRun& run);

/// `summary.json`: every number that the run printed, whence it is, and resolved options. Throws
/// UserError if it cannot be written.
void write_summary(const std::string& path, const FinishedRun& run);

}  // namespace pounding
