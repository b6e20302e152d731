#include <algorithm>
#include <cmath>
#include <string>

#include "common/byte_texts.h"
#include "common/facts_of.h"
#include "common/vector_unit.h"
#include "model/time_step.h"
#include "report/report.h"

namespace pounding {
namespace {

/// Load of one contact at rest.
struct ContactLoad {
  int points = 0;    ///< of its pairs
  int closed = 0;    ///< of them, those that carry
  double force = 0;  ///< [N]
};

std::vector<ContactLoad> contact_loads(const Scene& scene, const Model& model) {
  std::vector<ContactLoad> loads(scene.contacts.size());
  for (std::size_t row = 0; row < model.equilibrium->contact_force.size(); ++row) {
    const double force = model.equilibrium->contact_force[row];
    ContactLoad& load = loads[model.interface.constraints[row].contact];
    load.force += force;
    load.closed += force > 0 ? 1 : 0;
    ++load.points;
  }
  return loads;
}

Facts structure_rest_facts(const Scene& scene, const Model& model, std::size_t s) {
  const StructureRest& of = model.equilibrium->structures[s];
  Facts facts{FACTS_OF(of, method, weight, load, support, contact, settlement, largest_displacement,
                       place, imbalance)};
  facts.say(
      "  structure {}, {method}\n"
      "    weight                 {weight:.6g} N\n"
      "[    loads                  {load:.6g} N\n]"
      "    supports push it by    {support:.6g} N\n",
      {model.systems[s].name});
  if (!scene.structures[s].clamps.empty()) {
    facts.say("      with the loads on held nodes, which recorded reactions are without\n");
  }
  if (!scene.contacts.empty()) facts.say("    contacts push it by    {contact:.6g} N\n");
  facts.say("    settles by             {settlement:.4g mm} in the mean");
  if (!of.place.empty()) facts.say(", at most {largest_displacement:.4g mm} at {place}");
  facts.say(model.systems[s].generalised
                ? "\n"
                : "\n    their sum is zero within {imbalance:.1e} of the largest\n");
  return facts;
}

std::string band_name(const FrequencyBand& band) {
  return sentence("{:.0f}-{:.0f}", {band.low, band.high});
}

/// rms per band, null in a band that has fewer than two frequencies.
Json band_values(const std::array<double, compared_bands.size()>& rms) {
  Json values = Json::object();
  for (std::size_t b = 0; b < compared_bands.size(); ++b) {
    values[band_name(compared_bands[b])] = rms[b] < 0 ? Json() : Json(rms[b]);
  }
  return values;
}

std::string told_bands(const std::array<double, compared_bands.size()>& rms) {
  std::string text;
  for (const double value : rms) {
    text += value < 0 ? "         -" : sentence("{:10.3g [%]}", {value});
  }
  return text;
}

/// The largest of a channel's errors per band, with the first letter of its cause where that is
/// not the reduction.
std::string told_largest(const FidelityEstimate& estimate, std::size_t channel) {
  std::string text;
  for (std::size_t b = 0; b < compared_bands.size(); ++b) {
    double largest = estimate.channels[channel].rms[b];
    std::string letter = " ";
    for (const ErrorPart& part : estimate.parts) {
      if (part.channels[channel].rms[b] <= largest) continue;
      largest = part.channels[channel].rms[b];
      letter = part.name.substr(0, 1);
    }
    text += largest < 0 ? "        - " : sentence("{:9.3g [%]}", {largest}) + letter;
  }
  return text;
}

Json channel_errors(std::span<const ChannelDistance> list) {
  Json channels = Json::object();
  for (const ChannelDistance& channel : list) {
    channels[channel.name] = {{"rms", band_values(channel.rms)},
                              {"largest", channel.largest},
                              {"largest_at", channel.at}};
  }
  return channels;
}

/// Whence the errors of full order are, and which of all is the largest.
void tell_parts(const FidelityEstimate& estimate, Facts& facts) {
  const std::string governs = estimate.governs() ? estimate.governs()->name : "reduction";
  for (const ErrorPart& part : estimate.parts) {
    facts.values["fidelity"][part.name] = {{"rms", band_values(part.rms)},
                                           {"order", part.order},
                                           {"order_measured", part.measured},
                                           {"channels", channel_errors(part.channels)}};
    facts.say("  the {}: {:.3g} times the change by half of it, which has the order {:.2g}{}\n",
              {part.name, part.extrapolation(), part.order,
               !part.measured     ? ", taken and not looked at"
               : part.order < 1.5 ? ", not 2"
                                  : ""});
  }
  if (!estimate.mesh.empty()) facts.say("  the mesh: {}\n", {estimate.mesh});
  facts.values["fidelity"]["governs"] = governs;
  facts.say("  the largest error is that of the {}\n", {governs});
}

/// A line on how fine a mesh must be whose error alone is beyond an accepted one; empty where it
/// is not, or not known.
std::string finer_mesh(const FidelityEstimate& estimate, double target) {
  const ErrorPart* mesh = estimate.part("mesh");
  if (mesh == nullptr || mesh->rms[0] < target) return "";
  return sentence(
      "  the mesh alone is {:.3g %} off, and must be finer: elements of {:.2g} times the size\n",
      {mesh->rms[0], 1 / mesh->refinement(target)});
}

/// Subject of a sentence about a fidelity, with its verb.
std::string fidelity_subject(int modes) {
  return modes > 0 ? std::to_string(modes) + " modes are" : "full order with scaled mass is";
}

}  // namespace

Facts warning_facts(std::span<const std::string> lines) {
  Facts facts{Json::array()};
  for (const std::string& line : lines) {
    facts.values.push_back(line);
    facts.say("warning: {}\n", {one_line(line)});
  }
  return facts;
}

Facts partition_facts(const Model& model) {
  Facts facts{{{"imbalance", model.partition_imbalance}, {"edge_cut", model.partition_edge_cut}}};
  facts.say("\npartition: imbalance {imbalance:.3f}, cut edges {edge_cut}\n");
  return facts;
}

Facts kernel_facts() {
  Facts facts{{{"vector_unit", vector_unit()}}};
  facts.say("kernels: vector unit {vector_unit}\n");
  return facts;
}

Facts time_step_facts(const Scene& scene, const Model& model) {
  Facts facts{
      {{"time_step", model.time_step}, {"stable_time_step", model.smallest_stable_time_step()}}};
  if (const double step = model.step_limits.resolved.accurate_step(); std::isfinite(step)) {
    facts.add("accurate_time_step", step);
  }
  facts.add("time_step_source", step_source_text(scene, model));
  if (std::isfinite(model.filler_time_step)) {
    facts.add("filler_time_step", model.filler_time_step,
              "fillers and stops allow a time step of {filler_time_step:.4e} s\n");
  }
  facts.add("steps", model.steps);
  facts.add("end_time", scene.end_time);
  facts.say(
      "time step {time_step} s ({:.3f} of the stable one), {steps} steps to {end_time} s\n"
      "  {time_step_source}\n",
      {model.time_step / model.smallest_stable_time_step()});
  if (model.step_source == StepSource::resolution) {
    facts.say("  earlier versions took {} s: see What changes your numbers in CHANGELOG.md\n",
              {earlier_time_step(scene, model)});
  }
  return facts;
}

Facts phase_facts(const PhaseReport& report) {
  const auto dofs = static_cast<double>(std::max<std::size_t>(1, report.dofs));
  Facts facts{{{"peak_memory", report.peak}}};
  facts.say("  {:-12s} {:10s} {:14s} {:14s} {:14s} {:10s}\n",
            {"phase", "time [s]", "memory [MB]", "at its end", "largest rank", "[B/dof]"});
  for (std::size_t number = 0; number < report.phases.size(); ++number) {
    const PhaseUse& use = report.phases[number];
    const char* const name = phase_name(static_cast<Phase>(number));
    facts.values["phases"][name] = use.seconds;
    facts.say("  {:-12s} {:10.3f}", {name, use.seconds});
    if (use.peak > 0) {
      facts.values["memory"][name] = {
          {"peak", use.peak}, {"largest_rank", use.largest_rank}, {"at_end", use.held}};
      facts.say(" {:14.0f [MB]} {:14.0f [MB]} {:14.0f [MB]} {:10.0f}",
                {use.peak, use.held, use.largest_rank, use.peak / dofs});
    }
    facts.say("\n");
  }
  facts.values["memory"]["mesher"] = report.mesher;
  facts.say("[  Gmsh's process held {memory/mesher:.0f MB} at most\n]");
  return facts;
}

Facts energy_facts(const RunStatistics& run) {
  const EnergyLine& energy = run.energy;
  Facts facts{FACTS_OF(energy, kinetic, strain)};
  facts.add("relative_residual", run.energy_residual);
  std::string sentences;
  for (std::size_t r = 0; r < ledger_rows.size(); ++r) {
    const LedgerRow& row = ledger_rows[r];
    if (row.key.empty()) continue;
    facts.values[std::string(row.key)] = energy.rows[r];
    if (std::abs(energy.rows[r]) > 1e-12 * std::abs(energy.energy())) {
      sentences += told(row.sentence, facts.values);
    }
  }
  facts.say(
      "\nenergy at the end [J]: kinetic {kinetic:.4g}, strain {strain:.4g}, damping loss "
      "{damping:.4g}, contact work {contact:.4g}, input work {input:.4g}\n");
  facts.text += sentences;
  facts.say(
      "  largest residual of the energy identity: {relative_residual:.2e} of the largest term\n");
  return facts;
}

Facts rest_facts(const Scene& scene, const Model& model) {
  const Equilibrium& rest = *model.equilibrium;
  Facts facts{FACTS_OF(rest, iterations, residual, rows_tried, acting_links, idle_links,
                       gravity_potential)};
  facts.say(
      "\nstatic equilibrium: {iterations} iterations, {residual:.1e} of the weight left, "
      "{rows_tried} contact points and links tried\n");
  Facts structures;
  for (std::size_t s = 0; s < rest.structures.size(); ++s) {
    structures.add(scene.structures[s].name, structure_rest_facts(scene, model, s));
  }
  facts.add("structures", structures);
  Facts contacts;
  const std::vector<ContactLoad> loads = contact_loads(scene, model);
  for (std::size_t c = 0; c < loads.size(); ++c) {
    const std::string& name = scene.contacts[c].name;
    contacts.add(name, Json{{"points", loads[c].closed}, {"force", loads[c].force}});
    contacts.say("  contact {}: {} of {} points carry {:.6g} N\n",
                 {name, loads[c].closed, loads[c].points, loads[c].force});
  }
  facts.add("contacts", contacts);
  if (rest.acting_links + rest.idle_links > 0) {
    facts.say(
        "  tension-only bars and compression-only springs: {acting_links} act, {idle_links} do "
        "not\n");
  }
  return facts;
}

Facts climb_facts(const Scene& scene) {
  const FidelityClimb& climb = scene.fidelity;
  Facts facts;
  if (climb.target == 0) return facts;
  facts.values = FACTS_OF(climb, target, modes, reason);
  facts.add("scaled_mass", climb.scaled);
  facts.add("tried", Json::array(), "fidelity target {target:.4g %}:");
  for (const TriedFidelity& one : climb.tried) {
    Json& of = facts.values["tried"].emplace_back(FACTS_OF(one, modes, error, wall_time));
    of["scaled_mass"] = one.modes == 0;
    facts.text +=
        told(" {} {error:.3g %} off ({wall_time:.0f} s),", of, {fidelity_subject(one.modes)});
  }
  facts.text += climb.modes > 0 || climb.scaled ? " " + fidelity_subject(climb.modes) + " tried\n"
                                                : " full order is taken, " + climb.reason + "\n";
  return facts;
}

Facts fidelity_facts(const Scene& scene, const RunStatistics& run) {
  Facts facts;
  if (scene.fidelity.target > 0) facts.values["fidelity_climb"] = climb_facts(scene).values;
  if (!run.fidelity) return facts;
  const FidelityEstimate& estimate = *run.fidelity;
  std::string lines;
  for (std::size_t c = 0; c < estimate.channels.size(); ++c) {
    const ChannelDistance& channel = estimate.channels[c];
    lines += sentence("  {:-24s}", {channel.name}) + told_largest(estimate, c) +
             sentence("  {:.3g [%]} at {:.4g} Hz\n", {channel.largest, channel.at});
  }
  FidelityEstimate::Bands whole{};
  for (std::size_t b = 0; b < whole.size(); ++b) whole[b] = estimate.whole(b);
  facts.add("fidelity", FACTS_OF(estimate, disturbance, impulse, full_impulse, full_dofs, wall_time,
                                 full_run_time, split_dofs, split_time, split_memory));
  facts.values["fidelity"].update({{"window", {estimate.start, estimate.end}},
                                   {"window_reason", estimate.reason},
                                   {"rms", band_values(estimate.rms)},
                                   {"window_rms", band_values(estimate.window)},
                                   {"spread_rms", band_values(estimate.spread)},
                                   {"mesh_not_judged", estimate.mesh},
                                   {"whole_rms", band_values(whole)},
                                   {"channels", channel_errors(estimate.channels)},
                                   {"full_time_step", estimate.time_step}});
  facts.say(
      "\nfloor spectra of this run beside full order ({fidelity/full_dofs} dofs), "
      "estimated by {fidelity/window:.4g} s at full order,\n"
      "  {fidelity/window_reason}, and by the motion changed by {fidelity/disturbance:.2g %}; rms "
      "of the logarithm of their ratio\n"
      "  in %, and the largest in the window; s: that of the step is larger, m: of the mesh\n");
  std::string head = sentence("  {:-24s}", {"Hz"});
  for (const FrequencyBand& band : compared_bands) head += sentence("{:10s}", {band_name(band)});
  const auto line = [](const char* name, const FidelityEstimate::Bands& rms) {
    return sentence("  {:-24s}", {name}) + told_bands(rms) + "\n";
  };
  facts.text += head + "\n" + lines + line("all that move", estimate.rms) +
                line("  of the window", estimate.window) +
                line("  of the disturbance", estimate.spread);
  for (const ErrorPart& part : estimate.parts) {
    facts.text += line(("of the " + part.name).c_str(), part.rms);
  }
  facts.text += line("all errors", whole);
  tell_parts(estimate, facts);
  facts.say(
      "  impulses in the window {fidelity/impulse:.5g} N s, at full order "
      "{fidelity/full_impulse:.5g}\n"
      "  the estimate took {fidelity/wall_time:.1f} s; the whole run at full order would take "
      "{fidelity/full_run_time:.0f} s\n");
  if (scene.fidelity.target > 0) {
    facts.text += finer_mesh(estimate, scene.fidelity.target);
    facts.say(
        "  {} {} the accepted {:.4g %}\n",
        {fidelity_subject(scene.fidelity.modes),
         estimate.whole(0) <= scene.fidelity.target ? "within" : "beyond", scene.fidelity.target});
  }
  return facts;
}

}  // namespace pounding
