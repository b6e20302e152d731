#include "driver/run_scene.h"

#include <algorithm>
#include <iterator>

#include "checks/run_doubts.h"
#include "common/error.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "common/process_state.h"
#include "driver/build_model.h"
#include "driver/matrix_export.h"
#include "driver/mesh_pieces.h"
#include "driver/time_loop.h"
#include "io/new_file.h"
#include "observers/field_plan.h"
#include "observers/floor_spectra.h"
#include "observers/kinds.h"
#include "observers/law_cycles.h"
#include "observers/model_file.h"
#include "output/result_folder.h"
#include "report/provenance.h"
#include "report/report.h"
#include "scene/resolved_options.h"

namespace pounding {
namespace {

/// Removes the results of an earlier run; the resolved options are the first thing in the folder.
/// Rank 0.
void begin_results(const Scene& scene, const OptionValues& resolved, const Provenance& provenance,
                   const ResultFolder& folder) {
  const std::vector<std::string> removed = folder.clear(scene.restart, result_files());
  if (!removed.empty()) print_removed(scene, removed);
  std::string files = "# Files of results:";
  for (const ResultFile& file : result_files()) files += " " + file.name;
  write_whole_file(scene.output + "/resolved.yaml",
                   resolved_yaml(resolved) + files + "\n" + provenance_comment(provenance));
}

[[noreturn]] void stop(const Scene& scene, const Model& model, int signal, std::int64_t step) {
  throw StoppedBySignal(sentence(
      "stopped by {} after step {} of {}, t = {} s; continue with -restart {}/checkpoint.h5",
      {signal_name(signal), step, model.steps, static_cast<double>(step) * model.time_step,
       scene.output}));
}

/// The state to continue from; none for a new run. Collective.
std::optional<SavedState> read_restart(MPI_Comm comm, const Scene& scene, const Model& model,
                                       const RunIdentity& identity) {
  if (scene.restart.empty()) return std::nullopt;
  SavedState saved = read_checkpoint(comm, scene.restart, identity, model.meshes, model.systems);
  const std::int64_t step = saved.integer("step");
  if (step < 0) saved.refuse_values("step");
  refuse_if(step > model.steps,
            sentence("option -end_time {} s: the checkpoint {} stands at {} s already",
                     {scene.end_time, scene.restart, static_cast<double>(step) * model.time_step}));
  if (rank_of(comm) == 0) print_restart(scene, model, step);
  return saved;
}

/// Tries the folders of a run before the work, and takes that of its results if it has any. Rank 0.
void take_folders(Scene& scene, const OptionValues& resolved, bool runs,
                  std::optional<ResultFolder>& folder) {
  if (runs || scene.write_modes || scene.write_model) try_folder("output", scene.output);
  if (!scene.export_matrices.empty()) try_folder("export_matrices", scene.export_matrices);
  if (!runs) return;
  folder.emplace(scene.output);
  Doubts(scene.warnings).add(replaced_results(scene, resolved));
}

/// Capacities of equipment, on rank 0; their corners become frequencies of the spectra. Collective.
std::vector<TargetSpectrum> take_capacities(MPI_Comm comm, Scene& scene) {
  std::vector<TargetSpectrum> capacities;
  on_rank0(comm, [&] {
    capacities = read_capacities(scene);
    scene.spectra.frequencies = with_capacities(scene.spectra.frequencies, capacities);
  });
  broadcast_array(comm, scene.spectra.frequencies);
  return capacities;
}

/// Loops of laws or pieces of meshes, in place of a run, where a scene asks for them. Collective.
bool write_in_place_of_run(MPI_Comm comm, Scene& scene, Profile& profile) {
  if (!scene.law_cycles.empty()) {
    write_law_loops(comm, scene);
  } else if (scene.write_mesh_pieces > 0) {
    write_mesh_pieces(comm, scene, profile);
  } else {
    return false;
  }
  return true;
}

/// Files of the model, and the beginning of the results. `folder`: of rank 0. Collective.
void write_before_run(MPI_Comm comm, const Scene& scene, const OptionValues& resolved,
                      const Provenance& provenance, const Model& model,
                      const std::optional<ResultFolder>& folder) {
  if (!scene.dry_run) {
    on_rank0(comm, [&] { begin_results(scene, resolved, provenance, *folder); });
    if (scene.write_model) write_model(comm, scene, model);
  }
  if (scene.write_modes) {
    on_rank0(comm, [&] { create_output(scene.output); });
    write_mode_shapes(comm, scene, model);
  }
  print_fields(comm, scene, model);
}

/// The last words of a dry run. Collective.
void end_dry_run(MPI_Comm comm, const Scene& scene, const Model& model, Profile& profile) {
  profile.note_memory(Phase::step);
  const PhaseReport phases = report_phases(comm, profile, model.dofs());
  if (rank_of(comm) != 0) return;
  print(phase_facts(phases));
  print("\n" + doubts_again({scene.warnings, model.warnings}));
}

/// Spectra, doubts and peaks of a run at its end; report and summary. `begun` [s]. Collective.
void end_run(MPI_Comm comm, const Scene& scene, const OptionValues& resolved,
             const Provenance& provenance, const Model& model, const TimeLoop& loop,
             const std::vector<TargetSpectrum>& capacities, double begun,
             RunStatistics& statistics) {
  const Recorder& recorder = loop.recorder();
  std::vector<ProbeSpectrum> spectra = compute_floor_spectra(comm, scene, recorder);
  on_rank0(comm, [&] {
    std::ranges::move(cabinet_spectra(scene, recorder, spectra), std::back_inserter(spectra));
    std::ranges::move(compute_ground_spectra(scene, *model.motion), std::back_inserter(spectra));
    write_floor_spectra(scene, spectra);
    statistics.peaks = stated_peaks(scene, recorder);
    statistics.warnings = run_doubts(scene, model, statistics, recorder, capacities);
    statistics.wall_time = MPI_Wtime() - begun;
    const FinishedRun finished{provenance,     scene,    resolved, model,      statistics,
                               loop.impacts(), recorder, spectra,  capacities, size_of(comm)};
    write_summary(scene.output + "/summary.json", finished);
    print_results(finished);
  });
}

}  // namespace

RunOutcome run_scene(MPI_Comm comm, ReadScene read, const SceneOrigin& origin,
                     const FidelityEstimator& estimator) {
  Scene& scene = read.scene;
  const OptionValues& resolved = read.resolved;
  flush_subnormal_numbers();
  return_large_arrays();
  const double start = MPI_Wtime();
  const bool root = rank_of(comm) == 0;
  Profile profile;
  const bool runs = !scene.dry_run && scene.law_cycles.empty() && scene.write_mesh_pieces == 0;
  std::optional<ResultFolder> folder;  // of rank 0
  on_rank0(comm, [&] { take_folders(scene, resolved, runs, folder); });
  const std::vector<TargetSpectrum> capacities = take_capacities(comm, scene);
  if (root) print_title(scene, overrides_text(origin), size_of(comm));
  if (write_in_place_of_run(comm, scene, profile)) return {};
  Provenance provenance;  // a dry run leaves no summary to tell it
  if (!scene.dry_run) provenance = note_provenance(comm, origin, resolved);
  if (!scene.restart.empty()) {
    check_checkpoint(comm, scene.restart, lasting_options(comm, resolved));
  }
  if (scene.dry_run && scene.write_model) on_rank0(comm, [&] { create_output(scene.output); });
  const Model model = build_model(comm, scene, read.stiffness_factors, profile);
  if (!scene.dry_run) note_model(comm, scene, model.buildings, provenance);
  return_freed_memory();
  if (root && !scene.dry_run) print_model(scene, model);
  if (!scene.export_matrices.empty()) export_matrices(comm, scene, model);
  const RunIdentity identity = identity_of(comm, resolved, model);
  const std::optional<SavedState> restart = read_restart(comm, scene, model, identity);
  write_before_run(comm, scene, resolved, provenance, model, folder);
  TimeLoop loop(comm, scene, model, profile);
  const double seconds = loop.measure(scene.dry_run ? 200 : 50);
  if (root && scene.dry_run) {
    print_prospect(scene, model, size_of(comm), MPI_Wtime() - start, seconds);
    print_model(scene, model);
  }
  if (root) print_time_step(scene, model, seconds);
  if (scene.dry_run) {
    end_dry_run(comm, scene, model, profile);
    return {};
  }
  RunStatistics statistics;
  const double step_start = MPI_Wtime();
  const int signal = loop.run(identity, restart ? &*restart : nullptr);
  statistics.step_time = MPI_Wtime() - step_start;
  loop.fill(statistics);
  if (signal != 0) stop(scene, model, signal, loop.step());
  if (estimator) {
    statistics.fidelity = estimator(scene, model, loop.impacts(), loop.recorder());
  }
  end_run(comm, scene, resolved, provenance, model, loop, capacities, start, statistics);
  RunOutcome outcome{MPI_Wtime() - start, 0, statistics.fidelity};
  MPI_Bcast(&outcome.wall_time, 1, MPI_DOUBLE, 0, comm);
  for (const Mesh& mesh : model.meshes) {
    outcome.dofs = std::max(outcome.dofs, static_cast<std::size_t>(mesh.global_dofs));
  }
  return outcome;
}

}  // namespace pounding
