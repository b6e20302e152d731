#include "scene/stop_reader.h"

#include <algorithm>
#include <cmath>

#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr std::string_view stop_along = "<contact>_along";
constexpr std::string_view stop_stiffness = "<contact>_stiffness";
constexpr std::string_view stop_dashpot = "<contact>_dashpot";

}  // namespace

std::optional<Vector3> point_of_side(const std::string& side) {
  const auto numbers = parse_reals(side);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  return Vector3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

std::optional<Stop> read_stop(OptionReader& options, const std::string& contact) {
  const OptionReader::Names names{contact};
  if (!options.given(stop_along, names)) {
    for (const std::string_view option : {stop_stiffness, stop_dashpot}) {
      options.forbid(option, names,
                     "it makes a stop of a contact that has a direction; give -" +
                         option_name(stop_along, names));
    }
    return std::nullopt;
  }
  Stop stop;
  const std::string word = options.text(stop_along, names);
  if (word != "line") {
    const auto along = point_of_side(word);
    const double length = along ? std::hypot((*along)[0], (*along)[1], (*along)[2]) : 0;
    if (!(length > 0) || !std::isfinite(length)) options.refuse(stop_along, names);
    stop.along = Vector3{(*along)[0] / length, (*along)[1] / length, (*along)[2] / length};
  }
  if (options.given(stop_stiffness, names)) stop.stiffness = options.real(stop_stiffness, names);
  stop.dashpot = options.real(stop_dashpot, names);
  if (stop.dashpot > 0 && !(stop.stiffness > 0)) {
    options.refuse(stop_dashpot, names,
                   "it goes with -" + option_name(stop_stiffness, names) + ", which is not given");
  }
  return stop;
}

void check_stop(const OptionReader& options, const Contact& contact, bool exports) {
  const OptionReader::Names names{contact.name};
  for (const char* option :
       {"<contact>_passes", "<contact>_gap_deviation", "<contact>_gap_patches", "<contact>_sliding",
        "<contact>_filler", "<contact>_filler_unloading", "<contact>_filler_thickness",
        "<contact>_filler_area", "<contact>_crushing", "<contact>_crushing_stiffness",
        "<contact>_crushing_depth", "<contact>_crushing_area"}) {
    options.forbid(option, names,
                   "-" + option_name(stop_along, names) +
                       " makes it a stop between nodes, which have no faces");
  }
  const std::vector<double>& gaps = contact.gap.values;
  if (gaps.empty() || gaps.size() > 2) {
    options.refuse("<contact>_gap", names,
                   "a stop takes one number, or two if it stops both ways; give the way until it "
                   "closes");
  }
  if (std::ranges::any_of(gaps, [](double gap) { return gap < 0; })) {
    options.refuse("<contact>_gap", names, "a stop is open or just closed; give 0 or more");
  }
  if (!contact.stop->along && contact.primary.is_wall()) {
    options.refuse(stop_along, names, "there is no line to a wall; give a direction x,y,z");
  }
  if (contact.friction > 0 && contact.is_elastic()) {
    options.refuse(
        "<contact>_friction", names,
        "not beside -" + option_name(stop_stiffness, names) + ": only a hard stop has friction");
  }
  if (contact.is_elastic() && exports) {
    options.refuse("export_matrices", {},
                   "stop " + contact.name + " gives way, which is no matrix; not with -" +
                       option_name(stop_stiffness, names));
  }
}

}  // namespace pounding
