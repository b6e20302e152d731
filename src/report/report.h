#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "common/facts.h"
#include "model/model.h"
#include "observers/floor_spectra.h"
#include "observers/impact_catalogue.h"
#include "observers/recorder.h"
#include "observers/run_statistics.h"
#include "report/provenance.h"
#include "scene/scene.h"

/// Report that a run prints, and its summary.json: both have the facts of the subjects (facts.h),
/// each in its order. For rank 0.
namespace pounding {

/// `overrides`: in words, how the run differs from the files of its options.
void print_title(const Scene& scene, const std::string& overrides, int ranks);
void print_model(const Scene& scene, const Model& model);
/// The first lines of a dry run: the steps that a run would make, its expected time as a whole on
/// so many ranks, its spectra measured here by a short signal, and the doubts. `set_up` [s]: taken
/// so far; `seconds_per_step`: measured, 0 if it was not. Rank 0.
void print_prospect(const Scene& scene, const Model& model, int ranks, double set_up,
                    double seconds_per_step);
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
  const OptionValues& resolved;  ///< options in force
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

/// Facts of each subject of a run, for rank 0, as the report prints and summary.json has them.

/// Facts of the ground motion by direction as it was understood, null where there is none, and of
/// the components in which supports move otherwise, and of the loads (record_facts.cpp).
Facts motion_facts(const GroundMotion& motion);
Facts support_facts(const SupportMotion& supports);
Facts load_facts(const Scene& scene, const Model& model);

/// Facts of a structure as it was built, of soil under its mat, spread springs and absorbing faces
/// (structure_facts.cpp); of its damping, basis and modes, scaled mass and stable step
/// (mode_facts.cpp).
Facts structure_facts(const Building& building);
Facts damping_facts(const Building& building);
Facts soil_facts(const Structure& structure);
Facts spread_facts(const Building& building);
Facts absorbing_facts(const Building& building);
Facts reduction_facts(const Building& building);
Facts mode_facts(const Building& building);
Facts scaling_facts(const Building& building);
Facts step_limit_facts(const Building& building);

/// Facts of a contact as it was found, those of a run null; of all contacts after a run; of the
/// impacts; of the joints that would be needed (contact_facts.cpp).
Facts contact_facts(const Scene& scene, const Model& model, std::size_t contact);
Facts joint_facts(const Scene& scene, const Model& model, const RunStatistics& run);
Facts impact_facts(const Scene& scene, const RunStatistics& run, const ImpactCatalogue& impacts);
Facts separation_facts(const Scene& scene, const Model& model);

/// Facts of the forces that hold a scene at rest that starts there (run_facts.cpp).
Facts rest_facts(const Scene& scene, const Model& model);

/// Facts of the ranks' parts, the kernels in use, the time step, a step on ranks that are not
/// there, energies, phases and warnings (run_facts.cpp).
Facts partition_facts(const Model& model);
Facts kernel_facts();
Facts time_step_facts(const Scene& scene, const Model& model);
Facts energy_facts(const RunStatistics& run);
Facts phase_facts(const PhaseReport& report);
Facts warning_facts(std::span<const std::string> lines);

/// Facts of the records: drifts, probes; the report has the peaks of spectra too
/// (record_facts.cpp). Those of other outputs come with them (RunStatistics::findings).
Facts drift_facts(const StoreyDrifts& drifts);
Facts probe_facts(const Scene& scene, const RunStatistics& run, const Recorder& recorder,
                  const std::vector<ProbeSpectrum>& spectra);

/// How the fidelity of a run was come to, none without an accepted error; and the error of its
/// floor spectra beside full order, none where it was not estimated (run_facts.cpp).
Facts climb_facts(const Scene& scene);
Facts fidelity_facts(const Scene& scene, const RunStatistics& run);

}  // namespace pounding
