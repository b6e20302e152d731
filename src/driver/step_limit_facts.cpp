#include <algorithm>
#include <cmath>
#include <numbers>

#include "driver/subject_facts.h"
#include "stability/stable_time_step.h"

namespace pounding {
namespace {

/// Facts of the scaled mass that reaches the target of the time step, and its cost.
Facts step_target_facts(const Building& building) {
  const StepTarget& target = *building.structure->step_target;
  const StepDesign& design = *building.design;
  const RotaryScaling& rotary = building.system->rotary_scaling;
  Facts facts{{{"time_step", target.time_step},
               {"stable_time_step_before", design.before},
               {"shells", rotary.elements},
               {"largest_drilling", rotary.drilling},
               {"largest_bending", rotary.bending},
               {"frequency", target.frequency},
               {"allowed_change", target.change},
               {"largest_change", design.change.largest()}}};
  if (design.structure.step_target->shells == 0) {
    facts.say(
        "  time step target {time_step:.4e} s: {stable_time_step_before:.4e} s is stable without "
        "scaled mass\n");
    return facts;
  }
  facts.say(
      "  time step target {time_step:.4e} s: the stable step grew {:.3g} times from "
      "{stable_time_step_before:.4e} s\n"
      "[    {shells} shells got rotational inertia, at most {largest_drilling:.3g} times their own "
      "about the normal and {largest_bending:.3g} in bending\n]"
      "    no frequency up to {frequency:.4g} Hz falls by more than {largest_change:.2g} of itself "
      "({allowed_change:.2g} is allowed): {:.2g} by the rotations of shells alone, {:.2g} by stiff "
      "beams, bars and springs alone\n",
      {design.after / design.before, design.change.by_rotations(), design.change.by_elements()});
  return facts;
}

Facts mass_scaling_facts(const Building& building) {
  const LinearSystem& system = *building.system;
  const MassScaling& scaling = system.mass_scaling;
  const double stable = building.limits.stable_time_step;
  Facts facts{{{"time_step", scaling.time_step},
               {"elements", scaling.elements},
               {"coupled_dofs", scaling.dofs},
               {"largest_factor", scaling.largest_factor}}};
  facts.say(
      "  mass scaled for a step of {time_step:.4e} s: {elements} elements, {coupled_dofs} coupled "
      "dofs, at most {largest_factor:.3e} s2 of their stiffness\n");
  const bool reached = std::max(stable, system.element_time_step_bound) >= scaling.time_step;
  if (!reached && !building.design) {
    facts.say(
        "    not reached: {} allows less, its mass is not scaled; the stable step is {:.4g} of the "
        "wanted one\n",
        {system.limiting_element, stable / scaling.time_step});
  }
  return facts;
}

/// Causes that shorten the step, and the gain of each remedy.
std::string told_remedies(const Building& building) {
  constexpr double worth_a_word = 1.3;
  const LinearSystem& system = *building.system;
  const double stable = building.limits.stable_time_step;
  const double cost = 2 / building.limits.largest.omega_max / stable;
  const auto uniform = uniform_in_place_of(system.damping, building.modal.first_frequency());
  std::string text;
  if (cost > worth_a_word && uniform) {
    text += sentence(
        "    Rayleigh damping costs {:.3g} times the steps that there would be without damping; "
        "uniform damping (-{}_damping_uniform {:.2g}) would cost {:.3g}\n",
        {cost, system.name, uniform->ratio, std::sqrt(uniform->at_once())});
  }
  const ScalingOffer& offer = system.scaling_offer;
  const double gain = offer.allowed / stable;
  if (offer.elements > 0 && gain > worth_a_word * offer.cost) {
    constexpr double frequency = 10;  // Hz
    const double beta = system.damping.beta;
    const double factor = offer.time_step / 4 * (2 * beta + system.stiffening() * offer.time_step);
    const double turn = 2 * std::numbers::pi * frequency;
    text += sentence(
        "    {} elements of {} hold the step: -{}_mass_scaling {:.3g} would allow at least {:.2g} "
        "times it, couple {:.2g} % of the dofs, which makes a step {:.2g} times as expensive, and "
        "move no frequency below {:.0f} Hz by more than {:.1g} %\n",
        {offer.elements, offer.groups, system.name, offer.time_step, gain, 100 * offer.share,
         offer.cost, frequency, 50 * factor * turn * turn});
  }
  return text;
}

/// The bound from single elements behind a limit; nothing where none has a stiffness and a mass.
std::string told_bound(double bound) {
  if (!std::isfinite(bound) || bound == 0) return "";
  return sentence(" (bound from single elements {:.4e})", {bound});
}

}  // namespace

Facts scaling_facts(const Building& building) {
  Facts target;
  Facts facts;
  if (building.design) target.add("time_step_target", step_target_facts(building));
  if (building.system->mass_scaling.time_step > 0) {
    facts.add("mass_scaling", mass_scaling_facts(building));
  }
  if (building.system->condensed_dofs > 0) {
    facts.add("condensed_dofs", building.system->condensed_dofs,
              "  {condensed_dofs} dofs without mass follow the springs that hold them\n");
  }
  facts.values.update(target.values);
  facts.text = target.text + facts.text;
  for (const Sliver& sliver : building.system->slivers) {
    facts.values["slivers"].push_back({{"element", sliver.element},
                                       {"time_step", sliver.time_step},
                                       {"median_of_group", sliver.median},
                                       {"number_in_group", sliver.count}});
  }
  return facts;
}

Facts step_limit_facts(const Building& building) {
  const LinearSystem& system = *building.system;
  const LargestFrequency& largest = building.limits.largest;
  Facts facts{{{"omega_max", largest.omega_max},
               {"omega_max_excess", largest.excess},
               {"omega_max_location", largest.location},
               {"element_frequency_bound", system.element_frequency_bound},
               {"stiffest_element", system.stiffest_element},
               {"stable_time_step", building.limits.stable_time_step},
               {"element_time_step_bound", system.element_time_step_bound},
               {"limiting_element", system.limiting_element},
               {"stable_time_step_undamped", 2 / largest.omega_max}}};
  if (building.basis) {
    facts.say(
        "  stable time step {stable_time_step:.4e} s, exact from the frequencies; it is that of "
        "{omega_max_location}\n");
    return facts;
  }
  facts.say(
      "  omega_max {omega_max:.4e} rad/s{}\n"
      "[    a bound after {} products, too large by {omega_max_excess:.2g %} at most: 1e-10 would "
      "take more than some seconds (-omega_max_tolerance)\n]"
      "    at {omega_max_location}\n"
      "[    stiffest: {stiffest_element}\n]"
      "  stable time step {stable_time_step:.4e} s{}, without damping "
      "{stable_time_step_undamped:.4e} s\n"
      "[    limiting: {limiting_element}\n]",
      {told_bound(system.element_frequency_bound), largest.excess > 0 ? largest.products : 0,
       told_bound(system.element_time_step_bound)});
  facts.text += told_remedies(building);
  if (!system.extra_damping) {
    facts.say("    damping ratio {:.2f} at omega_max\n",
              {system.uniform_damping ? system.uniform_damping->ratio_at(largest.omega_max)
                                      : damping_ratio(system.damping, largest.omega_max)});
  }
  return facts;
}

}  // namespace pounding
