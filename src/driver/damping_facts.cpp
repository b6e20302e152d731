#include <numbers>

#include "driver/subject_facts.h"
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

Json rayleigh_values(const Rayleigh& damping) {
  return {{"alpha", damping.alpha}, {"beta", damping.beta}};
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
    facts.values["filters"].push_back({{"weight", filter.weight}, {"rate", filter.rate}});
  }
  if (damping.filters.empty()) {
    facts.say("  uniform damping of {uniform:.4g %} from {band} Hz: none\n");
    return facts;
  }
  facts.say(
      "  uniform damping of {uniform:.4g %} from {band} Hz within {ripple:.2g %} of it, {} "
      "filters; "
      "ratio at 1, 10, 100, 400 Hz:{}"
      "    stiffness: that of the materials at {reference_frequency} Hz and under the weight at "
      "rest, {stiffness_at_rest:.4f} of it for the slowest motions, "
      "{stiffness_of_fastest_motions:.4f} for the fastest\n",
      {damping.filters.size(), told_ratios([&](double omega) { return damping.ratio_at(omega); })});
  return facts;
}

}  // namespace

Facts damping_facts(const Building& building) {
  const Structure& structure = *building.structure;
  const std::optional<UniformDamping>& uniform = building.system->uniform_damping;
  const bool by_mode = structure.modal && !structure.modal->damping_ratios.empty();
  Facts facts;
  if (uniform) {
    facts.add("damping", uniform_damping_facts(*uniform));
  } else {
    facts.add("damping", rayleigh_values(structure.damping));
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
    if (!region.damping) continue;
    facts.values["region_damping"][region.group] = rayleigh_values(*region.damping);
    if (uniform || by_mode) continue;
    facts.say("    of {}:{}", {region.group, told_ratios(*region.damping)});
  }
  return facts;
}

}  // namespace pounding
