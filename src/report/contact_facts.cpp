#include <algorithm>
#include <cmath>

#include "checks/run_doubts.h"
#include "common/facts_of.h"
#include "report/report.h"

namespace pounding {

namespace {

/// A stop between nodes, in place of the facts of faces.
Facts with_stop(const Stop& stop, const interactions::InterfaceReport& report, Facts facts) {
  facts.values["stop"] = {{"stiffness", stop.stiffness > 0 ? Json(stop.stiffness) : Json()},
                          {"dashpot", stop.dashpot}};
  facts.say(
      "\nstop {}: {pairs} rows between nodes along {normal:.3g}, gap {:.4g [mm]} to {:.4g mm}",
      {report.contact, report.smallest_gap, report.largest_gap});
  if (stop.stiffness > 0) {
    facts.say(", {stop/stiffness:.4g} N/m and {stop/dashpot:.4g} N s/m beyond it\n");
  } else {
    facts.say(", hard\n");
  }
  return facts;
}

/// Sentences about the gaps of faces, with the facts of their patches.
Facts with_gaps(const Contact& contact, const interactions::InterfaceReport& report, bool at_rest,
                Facts facts) {
  for (std::size_t p = 0; p < report.patch_pairs.size(); ++p) {
    const Json patch{{"gap", contact.gap.patches[p].gap}, {"pairs", report.patch_pairs[p]}};
    facts.values["gap_patches"].push_back(patch);
    facts.text += told("  patch {}: {pairs} pairs with a gap of {gap:.4g mm}\n", patch, {p + 1});
  }
  if (const interactions::SurveyReport& survey = report.survey; survey.points > 0) {
    facts.values["survey"] = {{"points", survey.points},
                              {"smallest", report.smallest_gap},
                              {"place_of_smallest", survey.narrowest},
                              {"mean", survey.mean_gap},
                              {"largest", report.largest_gap},
                              {"pairs_beyond", survey.beyond},
                              {"farthest_beyond", survey.farthest}};
    facts.say(
        "  surveyed at {survey/points} points: as built at least {survey/smallest:.4g mm} at "
        "{survey/place_of_smallest:.4g} m, {survey/mean:.4g mm} in the mean; {survey/pairs_beyond} "
        "pairs lie beyond the points, by at most {survey/farthest_beyond:.4g} m\n");
  }
  if (at_rest) {
    facts.say("  gap at rest {initial_gap:.4g mm}, unloaded {unloaded_gap:.4g mm}\n");
  }
  if (contact.gap_assumed_so) {
    facts.say(
        "  the gap given is that at rest (earlier versions took it for that of the unloaded "
        "meshes); -{}_gap_at rest or unloaded tells which\n",
        {report.contact});
  }
  if (report.carried > 0) {
    facts.say(
        "  {carried_nodes} more nodes are held by those of the face that they follow in a tie\n");
  }
  if (report.half_thickness[0] > 0 || report.half_thickness[1] > 0) {
    facts.say(
        "  of the meshes {geometric_gap:.4g mm} between surfaces, half a thickness off: "
        "{half_thickness/0:.4g [mm]} and {half_thickness/1:.4g mm}\n");
  }
  if (contact.crushes()) {
    facts.say(
        "  faces of {crushing/area:.4g} m2 are crushed by {crushing/strength:.4g} Pa, hard after "
        "{crushing/depth:.4g mm}\n");
  } else if (report.filler_area > 0) {
    facts.say("  filler of {filler/area:.4g} m2, {filler/thickness:.4g mm} thick, in the gap\n");
  }
  return facts;
}

Json values_of(const ImpactTotals& totals) {
  return FACTS_OF(totals, episodes, total_impulse, largest_impulse, peak_force, window_force,
                  max_penetration, energy_lost, friction_loss);
}

Json values_of(const SeparationSide& side) {
  return {{"structure", side.structure},
          {"peak_displacement", side.peak},
          {"modes", side.modes},
          {"frequency", side.frequency},
          {"damping_ratio", side.ratio}};
}

std::string told_side(const Json& side) {
  return told(
      " {structure} {peak_displacement:.4g mm}"
      "[ ({modes} modes, most at {frequency:.4g} Hz, {damping_ratio:.3g %})]",
      side);
}

/// Adds the loads of a filler, of faces that are crushed or of an elastic stop to the facts of its
/// contact. Returns the sentence of the report.
std::string add_loads(const Contact& contact, const interactions::FillerTotals& filler, Json& of) {
  if (contact.is_elastic()) {
    of["stop"].update({{"peak_force", filler.peak_force}, {"energy_lost", filler.loss}});
    return told("  {:-12s} stop pressed by at most {peak_force:.4g kN}, took {energy_lost:.4g} J\n",
                of["stop"], {contact.name});
  }
  Json& loads = of[contact.crushes() ? "crushing" : "filler"];
  loads.update(FACTS_OF(filler, peak_pressure, peak_force));
  const std::string pressed =
      told(" pressed by at most {peak_pressure:.4g kPa}, {peak_force:.4g kN} in all, crushed by ",
           loads);
  if (!contact.crushes()) {
    loads.update({{"crushed_strain", filler.crushed_strain}, {"energy_lost", filler.loss}});
    return told("  {:-12s} filler", loads, {contact.name}) + pressed +
           told("{crushed_strain:.3g %}, took {energy_lost:.4g} J\n", loads);
  }
  loads.update(FACTS_OF(filler, crushed_depth, crushed_place));
  loads["energy_lost"] = filler.loss;
  return told("  {:-12s} faces", loads, {contact.name}) + pressed +
         told("{crushed_depth:.4g mm}", loads) +
         (filler.crushed_depth > 0 ? told(" at ({crushed_place/0:.4g}, {crushed_place/1:.4g}) m, "
                                          "took {energy_lost:.4g} J",
                                          loads)
                                   : "") +
         "\n";
}

/// Adds how deep nodes went in a pass that is not taken. Returns the sentence of the report.
std::string add_other_pass(const Contact& contact, const OtherPass& other, Json& of) {
  if (!(other.depth > 0)) return "";
  of["other_pass"] = FACTS_OF(other, depth, facet_size, place, time);
  return told(
      "  {:-12s} nodes of the primary, of which no pass is taken, went into it by at most "
      "{depth:.3g mm}, at ({place/0:.4g}, {place/1:.4g}) m, t = {time:.4g} s\n",
      of["other_pass"], {contact.name});
}

}  // namespace

Facts contact_facts(const Scene& scene, const Model& model, std::size_t c) {
  const Contact& contact = scene.contacts[c];
  const interactions::InterfaceReport& report = model.interface.reports[c];
  const JointGaps& gaps = model.joint_gaps[c];
  Facts facts{FACTS_OF(report, passes, pairs, matched, unmatched_nodes, geometric_gap,
                       half_thickness, normal)};
  facts.values.update({{"closing_factor_scales", scaled_by_closing(scene)},
                       {"carried_nodes", report.carried},
                       {"initial_gap", gaps.at_rest},
                       {"unloaded_gap", gaps.unloaded},
                       {"overlapping_pairs", report.overlapping},
                       {"other_pass", nullptr}});
  if (contact.crushes()) {
    facts.values["crushing"] = {{"area", report.filler_area},
                                {"depth", contact.filler->thickness},
                                {"strength", contact.filler->table.back().pressure}};
  } else if (contact.filler) {
    facts.values["filler"] = {{"area", report.filler_area}, {"thickness", report.filler_thickness}};
  }
  if (contact.stop) return with_stop(*contact.stop, report, std::move(facts));
  facts.say(
      "\ncontact {}: {pairs} pairs ({matched} node to node), {unmatched_nodes} secondary nodes "
      "face nothing, initial gap {:.4g [mm]} to {:.4g mm}, normal {normal:.3g}\n",
      {report.contact, report.smallest_gap, report.largest_gap});
  if (report.passes == 2) {
    facts.say("  in two passes: nodes of either side are kept out of the other\n");
  }
  return with_gaps(contact, report, model.equilibrium.has_value(), std::move(facts));
}

Facts joint_facts(const Scene& scene, const Model& model, const RunStatistics& run) {
  Facts facts;
  std::string closings;
  std::string slides;
  const bool apart = run.all_impacts.episodes == 0;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    const auto& [closing, factor] = run.closings[c];
    Json& of = facts.values[contact.name] = contact_facts(scene, model, c).values;
    of.update({{"largest_closing", closing},
               {"closing_factor", std::isfinite(factor) ? Json(factor) : Json()},
               {"largest_slide", run.slides[c].distance},
               {"slide_facet_size", run.slides[c].facet_size}});
    closings += add_other_pass(contact, run.other_passes[c], of) +
                told("  {:-12s} closed by at most {largest_closing:.4g mm} in the samples", of,
                     {contact.name});
    if (apart) {
      closings += told(
          "[; if all stays linear, {closing_factor:.4g} times the {closing_factor_scales} closes "
          "it]",
          of);
    }
    closings += '\n';
    slides +=
        told("  {:-12s} slid along itself by at most {largest_slide:.4g mm}", of, {contact.name});
    if (contact.sliding > 0) {
      slides += told(", of {:.4g mm} within which pairs are found anew", of, {contact.sliding});
    } else if (run.slides[c].facet_size > 0) {
      slides += told(", on a facet of {slide_facet_size:.4g mm}", of);
    }
    slides += '\n';
    if (!contact.filler && !contact.is_elastic()) continue;
    facts.text += add_loads(contact, run.fillers[c], of);
  }
  facts.text += closings + slides;
  return facts;
}

Facts impact_facts(const Scene& scene, const RunStatistics& run, const ImpactCatalogue& impacts) {
  Facts facts{values_of(run.all_impacts)};
  facts.add("force_window", scene.force_window);
  facts.add("complementarity_residual", run.complementarity_residual);
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    facts.add(scene.contacts[c].name, values_of(run.impacts[c]));
  }
  if (scene.contacts.empty()) return facts;
  facts.say(
      "\nimpacts: {episodes} episodes, total impulse {total_impulse:.1f} N s, largest "
      "{largest_impulse:.1f} N s, penetration at most {max_penetration:.2e} m\n");
  constexpr std::size_t shown = 20;
  if (!impacts.impacts().empty()) {
    facts.say(
        "  contact         start s  duration ms  impulse N s  kN over {force_window:.3g ms}  of a "
        "step  points  lost J\n");
  }
  for (std::size_t i = 0; i < std::min(shown, impacts.impacts().size()); ++i) {
    const Impact& impact = impacts.impacts()[i];
    facts.say(
        "  {:-12s} {:10.5f} {:12.3f [ms]} {:12.2f} {:14.1f [kN]} {:10.1f [kN]} {:7d} {:7.2f}\n",
        {scene.contacts[impact.contact].name, impact.start, impact.duration(), impact.impulse,
         impact.window_force, impact.peak_force, impact.points, impact.energy_lost});
  }
  facts.say("[  ... and {} more in impacts.csv\n]",
            {std::max(shown, impacts.impacts().size()) - shown});
  return facts;
}

Facts separation_facts(const Scene& scene, const Model& model) {
  Facts facts;
  for (const Separation& one : model.separations) {
    const std::string& name = scene.contacts[one.contact].name;
    Json of = FACTS_OF(one, gap, correlation, sum, srss, ddc, modal);
    of.update({{"secondary", values_of(one.secondary)}, {"primary", values_of(one.primary)}});
    facts.add(
        "separations", name, of,
        "\njoint {}, {gap:.4g mm}: peaks along its normal by response spectrum:{},{}\n"
        "  needed so that nothing hits: modal {modal:.4g mm}, DDC {ddc:.4g [mm]} (correlation "
        "{correlation:.3f}), SRSS {srss:.4g [mm]}, sum {sum:.4g [mm]}\n",
        {name, told_side(of["secondary"]), told_side(of["primary"])});
  }
  if (!model.separations.empty()) {
    facts.say(
        "  SRSS is the rule of EN 1998-1 4.4.2.7 (times 0.7 where all floors are level) and of "
        "ASCE 7-16 12.12.3;\n  displacements are elastic, factors q and Cd/Ie not in them\n");
  }
  return facts;
}

}  // namespace pounding
