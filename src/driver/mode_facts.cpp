#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/component_names.h"
#include "driver/subject_facts.h"

namespace pounding {

Facts reduction_facts(const Building& building) {
  const ModalModel& modal = *building.structure->modal;
  const ModalBasis& basis = *building.basis;
  const MassScaling& scaling = building.system->mass_scaling;
  Facts facts{
      {{"coordinates", basis.size()},
       {"modes", basis.modes},
       {"attachment_vectors", basis.attachment_vectors},
       {"largest_frequency", std::sqrt(basis.squared_frequency.back()) / (2 * std::numbers::pi)}}};
  if (!modal.damping_ratios.empty()) facts.add("damping_ratios", modal.damping_ratios);
  facts.say(
      "  modal reduction: {coordinates} generalised coordinates for {} dofs\n    {modes} modes",
      {basis.full_dofs});
  if (modal.cutoff > 0) {
    facts.say(", those below the cut-off of {} Hz", {modal.cutoff});
  } else if (modal.candidates > modal.modes) {
    facts.say(", chosen among the {} lowest", {modal.candidates});
  } else if (modal.modes > basis.modes) {
    facts.say(" ({} asked for, the structure has no more)", {modal.modes});
  }
  facts.say(
      "\n    {attachment_vectors} attachment vectors{}\n"
      "    largest frequency {largest_frequency:.4g} Hz\n",
      {modal.attachment ? "" : " (not asked for)"});
  facts.say("[    mass scaled for a step of {:.4e} s: {} coordinates\n]",
            {scaling.time_step, scaling.dofs});
  return facts;
}

namespace {

Facts mode_facts(const Mode& mode, const Building& building, int number) {
  const std::optional<UniformDamping>& uniform = building.system->uniform_damping;
  const auto& mass = mode.effective_modal_mass;
  Facts facts{{{"frequency", mode.frequency},
               {"direction", mode.direction},
               {"fraction", mode.direction_fraction},
               {"effective_mass", std::max({0.0, mass[0], mass[1], mass[2]})},
               {"effective_modal_mass", mass}}};
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
              {moved / mode.frequency - 1, uniform->ratio_at(2 * std::numbers::pi * moved)});
  }
  if (mode.region.region >= 0) {
    const auto region = static_cast<std::size_t>(mode.region.region);
    facts.add("group", building.full_order().regions[region].group);
    facts.add("group_share", mode.region.share, ", {group} has {group_share:.1f %} of the motion");
  }
  facts.say("\n");
  return facts;
}

}  // namespace

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

}  // namespace pounding
