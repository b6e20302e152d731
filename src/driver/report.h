#pragma once

#include <span>
#include <string>

#include "driver/floor_spectra.h"
#include "driver/model.h"
#include "driver/run_statistics.h"
#include "output/impact_catalogue.h"
#include "scene/scene.h"

/// Report that a run prints; to be called on rank 0 only.
namespace pounding {

/// `overrides`: in words, how the run differs from the files of its options.
void print_title(const Scene& scene, const std::string& overrides, int ranks);
void print_model(const Scene& scene, const Model& model);
void print_partition(const Model& model);
void print_warnings(const std::vector<std::string>& warnings);
/// `seconds_per_step`: measured, 0 if it was not.
void print_time_step(const Scene& scene, const Model& model, double seconds_per_step);
/// `files`: what was removed from the folder of results.
void print_removed(const Scene& scene, std::span<const std::string> files);
/// `step`: that of the checkpoint from which the run continues.
void print_restart(const Scene& scene, const Model& model, std::int64_t step);
void print_results(const Scene& scene, const RunStatistics& statistics,
                   const ImpactCatalogue& impacts, const Recorder& recorder,
                   const std::vector<ProbeSpectrum>& spectra);

}  // namespace pounding
