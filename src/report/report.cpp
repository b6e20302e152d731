#include "report/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/byte_texts.h"
#include "common/version.h"
#include "io/new_file.h"
#include "io/schema.h"
#include "motion/response_spectrum.h"
#include "observers/kinds.h"

namespace pounding {
namespace {

double microseconds_per_step(const RunStatistics& run) {
  return 1e6 * run.step_time / static_cast<double>(std::max<std::int64_t>(1, run.steps));
}

/// A value whose texts and keys JSON can have.
Json with_readable_texts(const Json& value) {
  if (value.is_string()) return readable(value.get_ref<const std::string&>());
  if (!value.is_structured()) return value;
  Json made = value.is_array() ? Json::array() : Json::object();
  for (const auto& [key, part] : value.items()) {
    if (value.is_array()) {
      made.push_back(with_readable_texts(part));
    } else {
      made[readable(key)] = with_readable_texts(part);
    }
  }
  return made;
}

std::string probe_places(const Scene& scene, const std::vector<ResolvedProbe>& probes) {
  constexpr std::size_t shown = 20;
  std::string text = probes.empty() ? "" : "\n";
  for (std::size_t p = 0; p < std::min(shown, probes.size()); ++p) {
    const ResolvedProbe& probe = probes[p];
    text += sentence("probe {}: {} node{} of {} at {:.6g}, at most {:.3g mm} from what was asked\n",
                     {probe.name, probe.nodes.size(), probe.nodes.size() == 1 ? "" : "s",
                      scene.structures[probe.structure].name, probe.position, probe.snap_distance});
  }
  return text + sentence("[  ... and {} more probes\n]", {std::max(shown, probes.size()) - shown});
}

/// The joint that misses most of the width that its mode shapes need.
std::string joint_needed(const Scene& scene, const Model& model) {
  const auto worst = std::ranges::max_element(
      model.separations, {}, [](const Separation& one) { return one.modal - one.gap; });
  if (worst == model.separations.end()) return "";
  return sentence("joint needed by response spectrum: {:.4g mm} in {}, where there are {:.4g mm}\n",
                  {worst->modal, scene.contacts[worst->contact].name, worst->gap});
}

std::string whether_they_hit(const FinishedRun& run) {
  if (run.scene.contacts.empty()) return "";
  const ImpactTotals& all = run.statistics.all_impacts;
  const auto& impacts = run.impacts.impacts();
  if (impacts.empty()) {
    if (run.statistics.closings.empty()) return "they do not hit\n";
    const auto nearest =
        std::ranges::max_element(run.statistics.closings, {}, &JointClosing::largest);
    return sentence(
        "they do not hit; {} closes most, by {:.4g mm}\n",
        {run.scene.contacts[static_cast<std::size_t>(nearest - run.statistics.closings.begin())]
             .name,
         nearest->largest});
  }
  const auto first = std::ranges::min_element(impacts, {}, &Impact::start);
  return sentence(
      "they hit: {} impact{}, the first at {:.4g} s in {}, {:.5g} N s in all, at most {:.4g kN} "
      "over {:.3g ms}\n",
      {all.episodes, all.episodes == 1 ? "" : "s", first->start,
       run.scene.contacts[first->contact].name, all.total_impulse, all.window_force,
       run.scene.force_window});
}

}  // namespace

std::string doubts_again(std::initializer_list<std::span<const std::string>> lists) {
  constexpr std::size_t shown = 8;
  std::vector<std::string> lines;
  for (const auto& list : lists) lines.insert(lines.end(), list.begin(), list.end());
  if (lines.empty()) return "no doubts\n";
  std::string text = sentence("doubts, {}:\n", {lines.size()});
  for (std::size_t i = 0; i < std::min(shown, lines.size()); ++i) {
    text += "  " + one_line(lines[i]) + "\n";
  }
  return text + sentence("[  ... and {} more above\n]", {std::max(shown, lines.size()) - shown});
}

void print_title(const Scene& scene, const std::string& overrides, int ranks) {
  print(sentence(
      "pounding {} ({}), PETSc {}, {} rank{}\n",
      {program_version(), program_commit(), petsc_version(), ranks, ranks == 1 ? "" : "s"}));
  if (!scene.title.empty()) print(one_line(scene.title) + "\n");
  if (!overrides.empty()) print("  " + one_line(overrides) + "\n");
  print(climb_facts(scene));
  print(warning_facts(scene.warnings));
}

void print_model(const Scene& scene, const Model& model) {
  print(motion_facts(*model.motion));
  if (model.supports) print(support_facts(*model.supports));
  if (model.load_histories) print(load_facts(scene, model));
  for (const Building& building : model.buildings) print(structure_facts(building));
  for (std::size_t c = 0; c < model.interface.reports.size(); ++c) {
    print(contact_facts(scene, model, c));
  }
  print(separation_facts(scene, model));
  if (model.equilibrium) print(rest_facts(scene, model));
  print(probe_places(scene, model.probes));
  print(partition_facts(model));
  print(kernel_facts());
  print(warning_facts(model.warnings));
}

void print_prospect(const Scene& scene, const Model& model, int ranks, double set_up,
                    double seconds_per_step) {
  const double interval = model.time_step * record_stride(scene, model);
  const std::vector<double> rest(20000);
  const double begin = MPI_Wtime();
  if (!model.probes.empty()) {
    response_spectra(rest, interval, scene.spectra.frequencies, scene.spectra.damping_ratios,
                     AfterRecord::ignored);
  }
  const double spectra = (MPI_Wtime() - begin) * scene.end_time / (20000 * interval) *
                         std::ceil(3.0 * static_cast<double>(model.probes.size()) / ranks);
  const double steps = seconds_per_step * static_cast<double>(model.steps);
  print(
      sentence("\nwould step {} structures with {} pairs of contacts to {} s, in {} steps\n"
               "expected time of the whole run: {:.2g} s: {:.2g} until its first step, {:.2g} of "
               "steps, {:.2g} of spectra, and what its files take\n",
               {model.buildings.size(), model.interface.constraints.size(), scene.end_time,
                model.steps, set_up + steps + spectra, set_up, steps, spectra}));
  print(doubts_again({scene.warnings, model.warnings}) + "\nin detail:\n");
}

void print_time_step(const Scene& scene, const Model& model, double seconds_per_step) {
  print(time_step_facts(scene, model));
  if (seconds_per_step > 0) {
    print(sentence(
        "expected wall time of the steps: {:.1f} s ({:.1f} microseconds per step, measured)\n",
        {seconds_per_step * static_cast<double>(model.steps), 1e6 * seconds_per_step}));
  }
  std::fflush(stdout);
}

void print_removed(const Scene& scene, std::span<const std::string> files) {
  print("removed from " + scene.output + ", left by an earlier run:");
  for (const std::string& file : files) print(" " + file);
  print("\n");
}

void print_restart(const Scene& scene, const Model& model, std::int64_t step) {
  print(sentence("continuing {} after step {}, t = {} s\n",
                 {scene.restart, step, static_cast<double>(step) * model.time_step}));
  std::fflush(stdout);
}

void print_results(const FinishedRun& run) {
  const Scene& scene = run.scene;
  const RunStatistics& statistics = run.statistics;
  print("\n");
  print(impact_facts(scene, statistics, run.impacts));
  print(joint_facts(scene, run.model, statistics));
  print(statistics.findings);
  print(drift_facts(run.recorder.drifts()));
  print(probe_facts(scene, statistics, run.recorder, run.spectra));
  print(fidelity_facts(scene, statistics));
  print("\n");
  print(warning_facts(statistics.warnings));
  print(energy_facts(statistics));
  print("\n");
  print(phase_facts(statistics.phases));
  print("\n" + whether_they_hit(run) + joint_needed(scene, run.model));
  print(doubts_again({scene.warnings, run.model.warnings, statistics.warnings}));
  print(sentence("wall time {:.2f} s, {:.3f} microseconds per step\n",
                 {statistics.wall_time, microseconds_per_step(statistics)}));
  print("results in " + one_line(scene.output) + "\n");
}

void write_summary(const std::string& path, const FinishedRun& run) {
  const Scene& scene = run.scene;
  const Model& model = run.model;
  const RunStatistics& statistics = run.statistics;
  Facts facts{{{"schema", schema::summary},
               {"title", scene.title},
               {"version", program_version()},
               {"commit", program_commit()}},
              ""};
  add_provenance(run.provenance, facts.values);
  for (std::size_t s = 0; s < model.buildings.size(); ++s) {
    Json& values = facts.values["structures"][model.buildings[s].name()];
    values = structure_facts(model.buildings[s]).values;
    const BoundingBox& box = model.interface.extents[s];
    if (box.low[0] <= box.high[0]) values["extent"] = {box.low, box.high};
  }
  if (model.equilibrium) facts.add("equilibrium", rest_facts(scene, model));
  facts.add("motion", motion_facts(*model.motion));
  if (model.supports) facts.add("supports", support_facts(*model.supports));
  if (model.load_histories) facts.add("loads", load_facts(scene, model));
  facts.add(time_step_facts(scene, model));
  facts.add("output_interval", run.recorder.interval());
  facts.add("ranks", run.ranks);
  facts.add("wall_time", statistics.wall_time);
  facts.add("microseconds_per_step", microseconds_per_step(statistics));
  facts.add(phase_facts(statistics.phases));
  facts.add("partition", partition_facts(model));
  facts.add("kernels", kernel_facts());
  facts.values["partition"]["interface_ranks"] = statistics.interface_ranks;
  facts.add("interface_looks", statistics.interface_looks);
  facts.add("contact_rows", statistics.contact_rows);
  facts.add("coupled_rows", statistics.coupled_rows);
  facts.add("energy", energy_facts(statistics));
  facts.add("impacts", impact_facts(scene, statistics, run.impacts));
  facts.add(separation_facts(scene, model));
  facts.add("contacts", joint_facts(scene, model, statistics));
  facts.add(statistics.findings);
  facts.add("drifts", drift_facts(run.recorder.drifts()));
  facts.add(probe_facts(scene, statistics, run.recorder, run.spectra));
  facts.add(equipment_facts(scene, run.capacities));
  facts.add(fidelity_facts(scene, statistics));
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), model.warnings.begin(), model.warnings.end());
  warnings.insert(warnings.end(), statistics.warnings.begin(), statistics.warnings.end());
  facts.add("warnings", warning_facts(warnings));
  facts.add("files", Json::array());
  for (const ResultFile& file : result_files()) {
    const bool itself = scene.output + "/" + file.name == path;
    if (!itself && !std::filesystem::exists(scene.output + "/" + file.name)) continue;
    facts.values["files"].push_back({{"name", file.name}, {"holds", file.holds}});
  }
  facts.add("options", Json::object());
  for (const auto& [name, value] : run.resolved) {
    facts.values["options"][name] = value;
  }
  write_whole_file(path, with_readable_texts(facts.values).dump(1) + '\n');
}

}  // namespace pounding
