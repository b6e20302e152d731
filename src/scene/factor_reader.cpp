#include "scene/factor_reader.h"

#include <algorithm>

namespace pounding {
namespace {

constexpr std::string_view damping_factor = "<structure>_damping_factor";
constexpr std::string_view stiffness_factor = "<structure>_stiffness_factor";

/// Part of the stiffness that a factor on K would leave out; empty if there is none.
std::string left_out(const Structure& structure) {
  if (structure.soil) return "its soil has a stiffness of its own";
  if (structure.p_delta) return "not with -" + structure.name + "_p_delta";
  if (!structure.matrices.empty() && !structure.modal) {
    return "not with -" + structure.name + "_matrices at full order; scale stiffness.mtx";
  }
  const auto series = std::ranges::find_if(
      structure.regions, [](const Region& region) { return region.nonlinear.has_series(); });
  if (series != structure.regions.end()) {
    return "the springs in series with dashpots of " + series->group + " are none of K";
  }
  const auto law = std::ranges::find_if(structure.regions, is_nonlinear);
  if (law == structure.regions.end()) return "";
  return "not with -" + option_name(law_option(*law), {structure.name, law->group});
}

}  // namespace

double read_damping_factor(OptionReader& options, const std::string& structure) {
  return options.real(damping_factor, {structure});
}

double read_stiffness_factor(OptionReader& options, Structure& structure) {
  const double factor = options.real(stiffness_factor, {structure.name});
  if (factor == 1) return factor;
  if (const std::string why = left_out(structure); !why.empty()) {
    options.refuse(stiffness_factor, {structure.name}, why);
  }
  if (!structure.modal) scale_stiffness(factor, structure);
  return factor;
}

void scale_stiffness(double factor, Structure& structure) {
  for (Region& region : structure.regions) {
    region.material.young *= factor;
    for (double& stiffness : region.stiffness) stiffness *= factor;
  }
}

}  // namespace pounding
