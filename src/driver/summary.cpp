#include "driver/summary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "common/version.h"
#include "driver/motion_report.h"
#include "driver/region_report.h"
#include "driver/rest.h"
#include "driver/soil_report.h"
#include "driver/time_step.h"
#include "io/new_file.h"
#include "io/schema.h"
#include "scene/resolved_options.h"
#include "stability/stable_time_step.h"

namespace pounding {
namespace {

using Json = nlohmann::ordered_json;

/// Seconds, and memory in bytes, by phase.
void describe_phases(const PhaseReport& report, Json& summary) {
  summary["peak_memory"] = report.peak;
  for (std::size_t number = 0; number < report.phases.size(); ++number) {
    const PhaseUse& use = report.phases[number];
    const char* const name = phase_name(static_cast<Phase>(number));
    summary["phases"][name] = use.seconds;
    if (use.peak == 0) continue;
    summary["memory"][name] = {
        {"peak", use.peak}, {"largest_rank", use.largest_rank}, {"at_end", use.held}};
  }
  summary["memory"]["mesher"] = report.mesher;
}

Json describe_damping(const Rayleigh& damping) {
  return {{"alpha", damping.alpha}, {"beta", damping.beta}};
}

Json describe_uniform_damping(const UniformDamping& damping) {
  Json description{{"uniform", damping.ratio},
                   {"band", {damping.lowest, damping.highest}},
                   {"ripple", damping.ripple},
                   {"reference_frequency", damping.reference},
                   {"stiffness_at_rest", damping.at_rest()},
                   {"stiffness_of_fastest_motions", damping.at_once()}};
  description["filters"] = Json::array();
  for (const DampingFilter& filter : damping.filters) {
    description["filters"].push_back({{"weight", filter.weight}, {"rate", filter.rate}});
  }
  return description;
}

Json describe_places(const Places& places) {
  Json description{{"count", places.count}};
  if (places.count > 0) description["first"] = places.first;
  return description;
}

Json describe_findings(const MeshFindings& findings) {
  const Connectivity& connectivity = findings.connectivity;
  Json description{{"pieces", connectivity.pieces.size()},
                   {"pieces_not_held", connectivity.loose_pieces()},
                   {"held_against_every_rigid_motion", connectivity.wholly_held()}};
  for (const Piece& piece : connectivity.pieces) {
    if (!piece.held) {
      description["not_held"].push_back({{"nodes", piece.nodes}, {"place", piece.place}});
    }
  }
  description["coincident_nodes_apart"] = describe_places(connectivity.coincident_apart);
  description["coincident_nodes_inside"] = describe_places(connectivity.coincident_inside);
  description["line_ends_in_elements"] = describe_places(connectivity.ends_inside);
  description["hinges_at_solids"] = describe_places(connectivity.hinges);
  description["single_beams_at_solids"] = describe_places(connectivity.lone_hinges);
  description["groups_without_use"] = Json::array();
  for (const UnusedElements& unused : findings.unused) {
    description["groups_without_use"].push_back(
        {{"group", unused.group}, {"kind", unused.kind}, {"elements", unused.count}});
  }
  return description;
}

Json describe_structure(const Building& building) {
  Json structure;
  const Mesh& mesh = *building.mesh;
  structure["nodes"] = mesh.global_nodes;
  structure["dofs"] = mesh.global_dofs;
  structure["dofs_before_clamping"] = mesh.global_dofs_unclamped;
  GlobalIndex elements = 0;
  for (const ElementBlock& block : mesh.blocks) {
    // A group of shells may have quadrangles and triangles, each in a block of its own.
    Json& count = structure["groups"][block.group];
    count = (count.is_null() ? 0 : count.get<GlobalIndex>()) + block.global_count;
    elements += block.global_count;
  }
  structure["elements"] = elements;
  structure["regions"] = describe_regions(*building.structure);
  structure["connectivity"] = describe_findings(building.findings);
  structure["mass"] = building.system->total_mass;
  structure["stiffness"] = building.system->stiffness_method;
  const std::optional<UniformDamping>& uniform = building.system->uniform_damping;
  structure["damping"] =
      uniform ? describe_uniform_damping(*uniform) : describe_damping(building.structure->damping);
  for (const Region& region : building.structure->regions) {
    if (region.damping) {
      structure["region_damping"][region.group] = describe_damping(*region.damping);
    }
  }
  if (building.compression) {
    structure["p_delta"] = {{"largest_compression", building.compression->force},
                            {"place", building.compression->place}};
  }
  if (building.structure->soil) structure["soil"] = describe_soil(*building.structure);
  if (!building.spread.empty()) {
    structure["spread_springs"] = describe_spread_springs(building.spread);
  }
  if (!building.structure->absorbing.empty()) {
    structure["absorbing"] = describe_absorbing(*building.structure, building.absorbing);
  }
  for (const RigidGroup& rigid : building.structure->rigid_groups) {
    const std::string option = rigid_option(rigid.kind);
    Json& body = structure["rigid_groups"].emplace_back(
        Json{{"group", rigid.name()}, {"kind", option.substr(option.find('_') + 1)}});
    for (const RigidBodyReport& report : building.system->rigid_bodies) {
      if (report.group != rigid.name()) continue;
      body.update({{"bodies", report.bodies},
                   {"nodes", report.nodes},
                   {"mass", report.mass},
                   {"dofs", report.dofs},
                   {"motions", report.motions}});
    }
  }
  if (building.basis) {
    const ModalBasis& basis = *building.basis;
    structure["modal"] = {
        {"coordinates", basis.size()},
        {"modes", basis.modes},
        {"attachment_vectors", basis.attachment_vectors},
        {"largest_frequency", std::sqrt(basis.squared_frequency.back()) / (2 * std::numbers::pi)}};
    if (!building.structure->modal->damping_ratios.empty()) {
      structure["modal"]["damping_ratios"] = building.structure->modal->damping_ratios;
    }
  }
  const MassScaling& scaling = building.system->mass_scaling;
  if (scaling.time_step > 0) {
    structure["mass_scaling"] = {{"time_step", scaling.time_step},
                                 {"elements", scaling.elements},
                                 {"coupled_dofs", scaling.dofs},
                                 {"largest_factor", scaling.largest_factor}};
  }
  if (building.design) {
    const StepTarget& target = *building.structure->step_target;
    const RotaryScaling& rotary = building.system->rotary_scaling;
    structure["time_step_target"] = {
        {"time_step", target.time_step},     {"stable_time_step_before", building.design->before},
        {"shells", rotary.elements},         {"largest_drilling", rotary.drilling},
        {"largest_bending", rotary.bending}, {"frequency", target.frequency},
        {"allowed_change", target.change},   {"largest_change", building.design->change.largest()}};
  }
  for (const Sliver& sliver : building.system->slivers) {
    structure["slivers"].push_back({{"element", sliver.element},
                                    {"time_step", sliver.time_step},
                                    {"median_of_group", sliver.median},
                                    {"number_in_group", sliver.count}});
  }
  if (!building.modal.method.empty()) structure["modes_by"] = building.modal.method;
  structure["frequencies"] = Json::array();
  for (const Mode& mode : building.modal.modes) {
    double effective_mass = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      effective_mass = std::max(effective_mass, mode.effective_modal_mass[d]);
    }
    structure["frequencies"].push_back({{"frequency", mode.frequency},
                                        {"direction", mode.direction},
                                        {"fraction", mode.direction_fraction},
                                        {"effective_mass", effective_mass},
                                        {"effective_modal_mass", mode.effective_modal_mass}});
    if (uniform) {
      structure["frequencies"].back()["damped_frequency"] = uniform->moved(mode.frequency);
    }
  }
  structure["omega_max"] = building.limits.largest.omega_max;
  structure["omega_max_excess"] = building.limits.largest.excess;
  structure["omega_max_location"] = building.limits.largest.location;
  structure["element_frequency_bound"] = building.system->element_frequency_bound;
  structure["stiffest_element"] = building.system->stiffest_element;
  structure["stable_time_step"] = building.limits.stable_time_step;
  structure["element_time_step_bound"] = building.system->element_time_step_bound;
  structure["limiting_element"] = building.system->limiting_element;
  structure["stable_time_step_undamped"] = 2 / building.limits.largest.omega_max;
  return structure;
}

Json describe_impacts(const ImpactTotals& totals) {
  return {{"episodes", totals.episodes},
          {"total_impulse", totals.total_impulse},
          {"largest_impulse", totals.largest_impulse},
          {"peak_force", totals.peak_force},
          {"window_force", totals.window_force},
          {"max_penetration", totals.max_penetration},
          {"energy_lost", totals.energy_lost},
          {"friction_loss", totals.friction_loss}};
}

Json describe_energy(const RunStatistics& statistics) {
  const EnergyLine& energy = statistics.energy;
  return {{"relative_residual", statistics.energy_residual},
          {"kinetic", energy.kinetic},
          {"strain", energy.strain},
          {"damping", energy.damping_loss},
          {"contact", energy.contact_work},
          {"friction", energy.friction_loss},
          {"input", energy.input_work},
          {"gravity", energy.gravity_work},
          {"devices", energy.device_work}};
}

Json describe_equilibrium(const Scene& scene, const Model& model) {
  const Equilibrium& rest = *model.equilibrium;
  Json description{{"iterations", rest.iterations}, {"residual", rest.residual},
                   {"rows_tried", rest.rows_tried}, {"acting_links", rest.acting_links},
                   {"idle_links", rest.idle_links}, {"gravity_potential", rest.gravity_potential}};
  for (std::size_t s = 0; s < rest.structures.size(); ++s) {
    const StructureRest& of = rest.structures[s];
    description["structures"][scene.structures[s].name] = {
        {"method", of.method},         {"weight", of.weight},
        {"support", of.support},       {"contact", of.contact},
        {"settlement", of.settlement}, {"largest_displacement", of.largest_displacement},
        {"place", of.place},           {"imbalance", of.imbalance}};
  }
  description["contacts"] = Json::object();
  const std::vector<ContactLoad> loads = contact_loads(scene, model);
  for (std::size_t c = 0; c < loads.size(); ++c) {
    description["contacts"][scene.contacts[c].name] = {{"points", loads[c].closed},
                                                       {"force", loads[c].force}};
  }
  return description;
}

Json describe_probe(const Scene& scene, const RunStatistics& statistics, const Recorder& recorder,
                    std::size_t p) {
  const ResolvedProbe& probe = recorder.probes()[p];
  Json description;
  description["structure"] = scene.structures[probe.structure].name;
  description["position"] = probe.position;
  description["nodes"] = probe.nodes.size();
  description["peak_acceleration"] = Json::array();
  description["sampled_peak_acceleration"] = Json::array();
  description["peak_displacement"] = Json::array();
  for (std::size_t d = 0; d < 3; ++d) {
    description["peak_acceleration"].push_back(statistics.peaks.acceleration[3 * p + d]);
    description["sampled_peak_acceleration"].push_back(recorder.peaks()[3 * p + d].acceleration);
    description["peak_displacement"].push_back(recorder.peaks()[3 * p + d].displacement);
  }
  return description;
}

Json describe_separation(const Separation& one) {
  const auto side = [](const SeparationSide& of) -> Json {
    return {{"structure", of.structure},
            {"peak_displacement", of.peak},
            {"modes", of.modes},
            {"frequency", of.frequency},
            {"damping_ratio", of.ratio}};
  };
  return {{"gap", one.gap},
          {"secondary", side(one.secondary)},
          {"primary", side(one.primary)},
          {"correlation", one.correlation},
          {"sum", one.sum},
          {"srss", one.srss},
          {"ddc", one.ddc},
          {"modal", one.modal}};
}

Json describe_loop(const LoopReport& loop) {
  const interactions::LinkTotals most = loop.whole();
  Json yielded = Json::array();
  for (std::size_t i = 0; i < loop.links.size(); ++i) {
    if (loop.totals[i].yielded > 0) yielded.push_back(loop.links[i]);
  }
  return {{"links", loop.links.size()},
          {"yielded", yielded},
          {"largest_elongation", most.largest_elongation},
          {"largest_force", most.largest_force},
          {"energy_taken", most.work}};
}

Json describe_forces(const ForceReport& force) {
  Json description = Json::object();
  for (std::size_t c = 0; c < force.components.size(); ++c) {
    const std::size_t e = force.largest(c);
    const ForcePeak& peak = force.peaks[e * force.components.size() + c];
    Json& of = description[force.components[c]];
    of = {{"peak", peak.value}, {"time", peak.time}};
    if (!force.elements[e].empty()) of["element"] = std::stoll(force.elements[e]);
  }
  return description;
}

Json describe_drift(const Storey& storey, const std::array<DriftPeak, 2>& peaks) {
  return {{"structure", storey.structure},
          {"upper", storey.upper},
          {"lower", storey.lower},
          {"height", storey.height},
          {"peak", {peaks[0].drift, peaks[1].drift}},
          {"time", {peaks[0].time, peaks[1].time}}};
}

Json describe_filler(const interactions::InterfaceReport& report,
                     const interactions::FillerTotals& totals) {
  return {{"area", report.filler_area},
          {"thickness", report.filler_thickness},
          {"peak_pressure", totals.peak_pressure},
          {"peak_force", totals.peak_force},
          {"crushed_strain", totals.crushed_strain},
          {"energy_lost", totals.loss}};
}

Json describe_contact(const interactions::InterfaceReport& report, const JointGaps& gaps,
                      const Slide& slide, const JointClosing& closing) {
  return {{"largest_closing", closing.largest},
          {"closing_factor", std::isfinite(closing.factor) ? Json(closing.factor) : Json()},
          {"pairs", report.pairs},
          {"matched", report.matched},
          {"unmatched_nodes", report.unmatched_nodes},
          {"carried_nodes", report.carried},
          {"initial_gap", gaps.at_rest},
          {"unloaded_gap", gaps.unloaded},
          {"geometric_gap", report.geometric_gap},
          {"overlapping_pairs", report.overlapping},
          {"half_thickness", report.half_thickness},
          {"largest_slide", slide.distance},
          {"slide_facet_size", slide.facet_size},
          {"normal", report.normal}};
}

}  // namespace

void write_summary(const std::string& path, const FinishedRun& run) {
  const auto& [provenance, scene, resolved, model, statistics, recorder, ranks] = run;
  Json summary;
  summary["schema"] = schema::summary;
  summary["title"] = scene.title;
  summary["version"] = program_version();
  summary["commit"] = program_commit();
  add_provenance(provenance, summary);
  for (const Building& building : model.buildings) {
    summary["structures"][building.name()] = describe_structure(building);
  }
  summary["structures_key"] = scene.structures_key;
  if (model.equilibrium) summary["equilibrium"] = describe_equilibrium(scene, model);
  summary["motion"] = describe_motion(*model.motion);
  if (model.supports) summary["supports"] = describe_supports(*model.supports);
  summary["time_step"] = model.time_step;
  summary["stable_time_step"] = model.smallest_stable_time_step();
  if (const double step = model.step_limits.resolved.accurate_step(); std::isfinite(step)) {
    summary["accurate_time_step"] = step;
  }
  summary["time_step_source"] = step_source_text(scene, model);
  if (std::isfinite(model.filler_time_step)) summary["filler_time_step"] = model.filler_time_step;
  summary["steps"] = model.steps;
  summary["end_time"] = scene.end_time;
  summary["output_interval"] = recorder.interval();
  summary["ranks"] = ranks;
  summary["wall_time"] = statistics.wall_time;
  summary["microseconds_per_step"] =
      1e6 * statistics.step_time / static_cast<double>(std::max<std::int64_t>(1, statistics.steps));
  describe_phases(statistics.phases, summary);
  summary["partition"] = {{"imbalance", model.partition_imbalance},
                          {"edge_cut", model.partition_edge_cut},
                          {"interface_ranks", statistics.interface_ranks}};
  summary["interface_looks"] = statistics.interface_looks;
  summary["contact_rows"] = statistics.contact_rows;
  summary["coupled_rows"] = statistics.coupled_rows;
  summary["energy"] = describe_energy(statistics);
  for (std::size_t s = 0; s < statistics.contact_ratios.size(); ++s) {
    const ContactRatio& ratio = statistics.contact_ratios[s];
    summary["contact_ratio"][scene.structures[s].name] = {
        {"end", ratio.now},
        {"smallest", ratio.smallest},
        {"time_of_smallest", ratio.time},
        {"time_below_80_percent", ratio.low_duration}};
  }
  summary["impacts"] = describe_impacts(statistics.all_impacts);
  summary["impacts"]["force_window"] = scene.force_window;
  summary["impacts"]["complementarity_residual"] = statistics.complementarity_residual;
  for (const Separation& one : model.separations) {
    summary["separations"][scene.contacts[one.contact].name] = describe_separation(one);
  }
  summary["contacts"] = Json::object();
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const interactions::InterfaceReport& report = model.interface.reports[c];
    summary["impacts"][scene.contacts[c].name] = describe_impacts(statistics.impacts[c]);
    summary["contacts"][scene.contacts[c].name] =
        describe_contact(report, model.joint_gaps[c], statistics.slides[c], statistics.closings[c]);
    if (scene.contacts[c].filler) {
      summary["contacts"][scene.contacts[c].name]["filler"] =
          describe_filler(report, statistics.fillers[c]);
    }
  }
  for (const LoopReport& loop : statistics.loops) summary["loops"][loop.name] = describe_loop(loop);
  for (const ForceReport& force : statistics.forces) {
    summary["forces"][force.name] = describe_forces(force);
    if (force.about) summary["moments_about"][force.name] = *force.about;
  }
  summary["drifts"] = Json::array();
  for (std::size_t s = 0; s < recorder.drifts().storeys().size(); ++s) {
    summary["drifts"].push_back(
        describe_drift(recorder.drifts().storeys()[s], recorder.drifts().peaks()[s]));
  }
  summary["peak_frequency"] = statistics.peaks.frequency;
  summary["probes"] = Json::object();
  for (std::size_t p = 0; p < recorder.probes().size(); ++p) {
    summary["probes"][recorder.probes()[p].name] = describe_probe(scene, statistics, recorder, p);
  }
  summary["warnings"] = Json::array();
  for (const auto* warnings : {&scene.warnings, &model.warnings, &statistics.warnings}) {
    for (const std::string& warning : *warnings) summary["warnings"].push_back(warning);
  }
  summary["options"] = Json::object();
  for (const auto& [name, value] : resolved_values(resolved)) summary["options"][name] = value;
  write_whole_file(path, summary.dump(1) + '\n');
}

}  // namespace pounding
