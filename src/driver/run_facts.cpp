#include <algorithm>
#include <cmath>

#include "common/byte_texts.h"
#include "common/vector_unit.h"
#include "driver/subject_facts.h"
#include "driver/time_step.h"

namespace pounding {
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
  Facts facts{{{"relative_residual", run.energy_residual},
               {"kinetic", energy.kinetic},
               {"strain", energy.strain},
               {"damping", energy.damping_loss},
               {"contact", energy.contact_work},
               {"friction", energy.friction_loss},
               {"input", energy.input_work},
               {"gravity", energy.gravity_work},
               {"loads", energy.load_work},
               {"devices", energy.device_work},
               {"plastic", energy.plastic_loss}}};
  facts.say(
      "\nenergy at the end [J]: kinetic {kinetic:.4g}, strain {strain:.4g}, damping loss "
      "{damping:.4g}, contact work {contact:.4g}, input work {input:.4g}\n");
  facts.say(
      "[  friction of contacts took {friction:.4g}\n]"
      "[  yielding, damage and crushing took {plastic:.4g}\n]"
      "[  of the input work that of gravity {gravity:.4g}\n]"
      "[  of the input work that of loads {loads:.4g}\n]");
  if (std::abs(energy.device_work) > 1e-12 * std::abs(energy.energy())) {
    facts.say(
        "  device work {devices:.4g}: of dashpots, one-way bars and springs, bearings that slide, "
        "and of regions with damping\n  of their own beside that of their structure\n");
  }
  facts.say(
      "  largest residual of the energy identity: {relative_residual:.2e} of the largest term\n");
  return facts;
}

}  // namespace pounding
