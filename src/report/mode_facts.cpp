#include <algorithm>
#include <cmath>
#include <numbers>

#include "checks/model_doubts.h"
#include "common/facts_of.h"
#include "common/types.h"
#include "model/switched_modes.h"
#include "report/report.h"
#include "stability/stable_time_step.h"

namespace pounding {
namespace {

/// Damping ratios at 1, 10, 100 and 400 Hz, as a line ends. `ratio`: of a circular frequency.
template <typename Ratio>
std::string told_ratios(const Ratio& ratio) {
  std::string text;
  for (const double frequency : {1.0, 10.0, 100.0, 400.0}) {
    text += sentence(" {:.3f %}", {ratio(2 * std::numbers::pi * frequency)});
  }
  return text + "\n";
}

std::string told_ratios(const Rayleigh& damping) {
  return told_ratios([&](double omega) { return damping_ratio(damping, omega); });
}

Facts uniform_damping_facts(const UniformDamping& damping) {
  Facts facts{{{"uniform", damping.ratio},
               {"band", {damping.lowest, damping.highest}},
               {"ripple", damping.ripple},
               {"reference_frequency", damping.reference},
               {"stiffness_at_rest", damping.at_rest()},
               {"stiffness_of_fastest_motions", damping.at_once()},
               {"filters", Json::array()}}};
  for (const DampingFilter& filter : damping.filters) {
    facts.values["filters"].push_back(FACTS_OF(filter, weight, rate));
  }
  if (damping.filters.empty()) {
    facts.say("  uniform damping of {uniform:.4g %} from {band} Hz: none\n");
    return facts;
  }
  facts.say(
      "  uniform damping of {uniform:.4g %} from {band} Hz within {ripple:.2g %} of it, {} "
      "filters; ratio at 1, 10, 100, 400 Hz:{}"
      "    stiffness: that of the materials at {reference_frequency} Hz and under the weight at "
      "rest, {stiffness_at_rest:.4f} of it for the slowest motions, "
      "{stiffness_of_fastest_motions:.4f} for the fastest\n",
      {damping.filters.size(), told_ratios([&](double omega) { return damping.ratio_at(omega); })});
  return facts;
}

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
  Facts facts{FACTS_OF(scaling, time_step, elements, largest_factor)};
  facts.add("coupled_dofs", scaling.dofs);
  facts.say(
      "  mass scaled for a step of {time_step:.4e} s: {elements} elements, {coupled_dofs} coupled "
      "dofs, at most {largest_factor:.3e} s2 of their stiffness\n");
  if (scaling.elements > 0 && !building.modal.modes.empty()) {
    const Mode& mode = *std::ranges::max_element(building.modal.modes, {}, &Mode::scaled_part);
    facts.add("largest_change", std::sqrt(1 - mode.scaled_part) - 1);
    facts.say(
        "    it changes these frequencies by {largest_change:.2g %} at most, that of {:.4g} Hz\n",
        {mode.frequency});
  }
  const bool reached = std::max(stable, system.element_time_step_bound) >= scaling.time_step;
  if (!reached && !building.design) {
    facts.say(
        "    not reached: {} allows less, its mass is not scaled; the stable step is {:.4g} of the "
        "wanted one\n",
        {system.limiting_element.empty() ? "something beside the elements"
                                         : system.limiting_element,
         stable / scaling.time_step});
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

Facts mode_facts(const Mode& mode, const Building& building, int number) {
  const std::optional<UniformDamping>& uniform = building.system->uniform_damping;
  const auto& mass = mode.effective_modal_mass;
  Facts facts{FACTS_OF(mode, frequency, direction, effective_modal_mass)};
  facts.add("fraction", mode.direction_fraction);
  facts.add("effective_mass", std::max({0.0, mass[0], mass[1], mass[2]}));
  const auto way = static_cast<std::size_t>(std::ranges::find(motion_names, mode.direction) -
                                            motion_names.begin());
  const bool moves = way < motion_names.size();  // else no direction: nothing moves
  facts.say(
      "  {:4d}  {frequency:9.3f}  {direction:-9s}  {:8.0f} {} {}, {fraction:4.1f %} about/along "
      "{direction}",
      {number, moves ? mass[way] : 0, moves && way >= 3 ? "kg m2 about" : "kg along",
       motion_names[way % 3]});
  if (uniform) {
    const double moved = uniform->moved(mode.frequency);
    facts.add("damped_frequency", moved);
    facts.say(", damped {damped_frequency:.3f} Hz ({:+.1f %}) at {:.3f %}",
              {mode.frequency > 0 ? moved / mode.frequency - 1 : 0,
               uniform->ratio_at(2 * std::numbers::pi * moved)});
  }
  if (mode.damping_weight != 1) {
    facts.add("damping_weight", mode.damping_weight, ", damping times {damping_weight:.3f}");
  }
  if (mode.region.region >= 0) {
    const auto region = static_cast<std::size_t>(mode.region.region);
    facts.add("group", building.full_order().regions[region].group);
    facts.add("group_share", mode.region.share, ", {group} has {group_share:.1f %} of the motion");
  }
  facts.say("\n");
  return facts;
}

double hertz(double squared_frequency) {
  return std::sqrt(std::max(squared_frequency, 0.0)) / (2 * std::numbers::pi);
}

/// Shares of the free mass along x, y, z that move in the modes of a basis.
std::array<double, 3> mass_in_modes(const ModalBasis& basis) {
  std::array<double, 3> share{};
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t i = 0; i < basis.size(); ++i) {
      const double part = basis.participation[d * basis.size() + i];
      if (basis.mode_numbers[i] > 0) share[d] += part * part / basis.inertia[d];
    }
  }
  return share;
}

/// The frequencies of residual vectors, and their price: the largest frequency that they raise.
void add_residual_facts(const ModalModel& modal, const ModalBasis& basis, Facts& facts) {
  std::vector<double> frequencies;
  for (const double square : basis.residual_squared_frequency) frequencies.push_back(hertz(square));
  const double without = hertz(basis.largest_without_residual);
  facts.add("residual_vectors", frequencies);
  if (frequencies.empty()) {
    facts.say(modal.residual ? "" : "    residual vectors not asked for\n");
    return;
  }
  std::ranges::sort(frequencies);
  facts.say("    {} residual vectors of the ground's motion, {:.4g} to {:.4g} Hz",
            {frequencies.size(), frequencies.front(), frequencies.back()});
  facts.say("; without them the largest frequency is {:.4g} Hz\n", {without});
}

}  // namespace

Facts reduction_facts(const Building& building) {
  const Structure& structure = *building.structure;
  const ModalModel& modal = *structure.basis();
  const ModalBasis& basis = structure.switched ? *building.open_basis : *building.basis;
  const MassScaling& scaling = building.system->mass_scaling;
  Facts facts{{{"coordinates", basis.size()},
               {"modes", basis.modes},
               {"attachment_vectors", basis.attachment_vectors},
               {"highest_mode", highest_mode(basis)},
               {"mass_in_modes", mass_in_modes(basis)},
               {"largest_frequency", hertz(basis.squared_frequency.back())}}};
  if (!modal.damping_ratios.empty()) facts.add("damping_ratios", modal.damping_ratios);
  if (structure.switched) {
    const double omega = 2 * std::numbers::pi * highest_mode(basis);
    const double part = modal.switched_part;
    facts.add("switched_part", part,
              "  switched: in modes once at most {switched_part:g} of its energy");
    facts.add("settling_time", settling_time(*building.system, omega, part),
              " is outside, to which motions above its highest mode fall within "
              "{settling_time:.3g} s of a strike\n");
  }
  facts.say(
      "  modal reduction: {coordinates} generalised coordinates for {} dofs\n    {modes} modes",
      {basis.full_dofs});
  if (modal.cutoff > 0) {
    facts.say(", those below the cut-off of {} Hz", {modal.cutoff});
  } else if (modal.candidates > modal.modes) {
    facts.say(", chosen among the {} lowest", {modal.candidates});
  } else if (modal.modes == 0) {
    facts.say(basis.modes == most_chosen_modes ? ", the most that are chosen"
                                               : ", chosen by their damping");
  } else if (modal.modes > basis.modes) {
    facts.say(" ({} asked for, the structure has no more)", {modal.modes});
  }
  facts.say(
      "\n    highest mode {highest_mode:.4g} Hz; the modes have {mass_in_modes/0:.1f %} of the "
      "mass along x, {mass_in_modes/1:.1f %} along y, {mass_in_modes/2:.1f %} along z\n"
      "    {attachment_vectors} attachment vectors{}\n",
      {modal.attachment || structure.switched ? "" : " (not asked for)"});
  add_residual_facts(modal, basis, facts);
  facts.say("    largest frequency {largest_frequency:.4g} Hz\n");
  facts.say("[    mass scaled for a step of {:.4e} s: {} coordinates\n]",
            {scaling.time_step, scaling.dofs});
  return facts;
}

Facts mode_facts(const Building& building) {
  Facts facts;
  if (!building.modal.method.empty()) {
    facts.add("modes_by", building.modal.method, "  modes by {modes_by}\n");
  }
  facts.add("frequencies", Json::array(),
            "  mode  frequency  direction  effective mass, share of it\n");
  int number = 0;
  for (const Mode& mode : building.modal.modes) {
    const Facts of = mode_facts(mode, building, ++number);
    facts.values["frequencies"].push_back(of.values);
    facts.text += of.text;
  }
  return facts;
}

Facts damping_facts(const Building& building) {
  const Structure& structure = *building.structure;
  const std::optional<UniformDamping>& uniform = building.system->uniform_damping;
  const bool by_mode = structure.modal && !structure.modal->damping_ratios.empty();
  Facts facts;
  if (uniform) {
    facts.add("damping", uniform_damping_facts(*uniform));
  } else {
    facts.add("damping", FACTS_OF(structure.damping, alpha, beta));
  }
  if (!uniform && by_mode) {
    facts.say(
        "  damping ratio per mode, the last one of all that follow and of vectors that are no "
        "mode:");
    for (const double ratio : structure.modal->damping_ratios) facts.say(" {:.3f %}", {ratio});
    facts.say("\n");
  } else if (!uniform) {
    facts.say("  damping ratio at 1, 10, 100, 400 Hz:{}", {told_ratios(structure.damping)});
  }
  for (const Region& region : structure.regions) {
    if (region.of_water || (!region.damping && region.damping_factor == 1)) continue;
    const Rayleigh damping = structure.damping_of(region);
    facts.values["region_damping"][region.group] = FACTS_OF(damping, alpha, beta);
    if (uniform || by_mode) continue;
    facts.say("    of {}:{}", {region.group, told_ratios(damping)});
  }
  return facts;
}

Facts scaling_facts(const Building& building) {
  Facts facts;
  if (building.design) facts.add("time_step_target", step_target_facts(building));
  if (building.system->mass_scaling.time_step > 0) {
    facts.add("mass_scaling", mass_scaling_facts(building));
  }
  if (building.system->condensed_dofs > 0) {
    facts.add("condensed_dofs", building.system->condensed_dofs,
              "  {condensed_dofs} dofs without mass follow the springs that hold them\n");
  }
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
  const auto named = [](const std::string& element) {
    return element.empty() ? Json() : Json(element);
  };
  Facts facts{{{"omega_max", largest.omega_max},
               {"omega_max_excess", largest.excess},
               {"omega_max_location", largest.location},
               {"element_frequency_bound", system.element_frequency_bound},
               {"stiffest_element", named(system.stiffest_element)},
               {"stable_time_step", building.limits.stable_time_step},
               {"element_time_step_bound", system.element_time_step_bound},
               {"limiting_element", named(system.limiting_element)},
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
