#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/doubts.h"
#include "motion/synthetic.h"
#include "observers/recorder.h"
#include "observers/run_statistics.h"

/// Doubts about a run, each a line about one thing that a user should look at.
namespace pounding {

/// The doubts about a run that has come to its end; `capacities`: of equipment. Rank 0.
std::vector<std::string> run_doubts(const Scene& scene, const Model& model,
                                    const RunStatistics& run, const Recorder& recorder,
                                    std::span<const TargetSpectrum> capacities);

/// Doubts that the recorded motion raises about small displacements. `largest`: displacement
/// [m]; `model_size`: largest extent of the scene [m].
std::vector<std::string> displacement_warnings(double largest, double model_size);

/// Steps whose contact problem was not solved to the end. `residual`: the largest complementarity
/// residual of the run [-].
std::vector<std::string> contact_warnings(double residual);

/// Adds doubts about contacts of one pass whose primary went deep into their secondary.
void add_pass_doubts(const Scene& scene, std::span<const OtherPass> passes, Doubts doubts);

/// Names of all that a closing factor multiplies: "motion", "motion and loads" where some of those
/// are not in the rest from which a run starts, "weight" likewise.
std::string scaled_by_closing(const Scene& scene);

/// One line if samples at this interval [s], of steps of so long [s], cannot hold the low-pass that
/// is asked for.
std::vector<std::string> lowered_peak_warnings(const Scene& scene, double interval,
                                               double time_step);

}  // namespace pounding
