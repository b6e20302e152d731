#include "scene/filler_reader.h"

#include <sstream>
#include <string_view>

#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr std::string_view filler_option = "<contact>_filler";
constexpr std::string_view unloading = "<contact>_filler_unloading";
constexpr std::string_view crushing_option = "<contact>_crushing";
constexpr std::string_view crushing_stiffness = "<contact>_crushing_stiffness";
constexpr std::string_view crushing_depth = "<contact>_crushing_depth";
constexpr std::string_view crushing_area = "<contact>_crushing_area";

std::vector<Filler::Point> read_filler_table(OptionReader& options,
                                             const OptionReader::Names& names) {
  std::vector<Filler::Point> points;
  Filler::Point before;
  for (const std::string& item : split(options.text(filler_option, names), ',')) {
    const std::vector<std::string> words = split(item, ':');
    const auto strain = words.size() == 2 ? parse_real(words[0]) : std::nullopt;
    const auto pressure = words.size() == 2 ? parse_real(words[1]) : std::nullopt;
    if (!strain || !pressure) {
      options.refuse(filler_option, names, "'" + item + "' is not strain:pressure");
    }
    if (!(*strain > before.strain && *strain <= 1)) {
      options.refuse(filler_option, names, "strains must rise from 0, to 1 at most");
    }
    if (!(*pressure >= before.pressure)) {
      options.refuse(filler_option, names, "pressures must not fall");
    }
    before = {*strain, *pressure};
    points.push_back(before);
  }
  if (!(before.pressure > 0)) options.refuse(filler_option, names, "it never presses");
  return points;
}

/// Refuses options that go with one that is not given.
void forbid_parts(const OptionReader& options, std::string_view option,
                  const OptionReader::Names& names) {
  for (const OptionRow& row : option_table()) {
    if (row.pattern.starts_with(std::string(option) + "_")) {
      options.forbid(row.pattern, names,
                     "goes with -" + option_name(option, names) + ", which is not given");
    }
  }
}

/// A strip of the faces: elastic up to its strength, which it keeps to its end.
std::optional<Filler> read_crushing(OptionReader& options, const OptionReader::Names& names) {
  if (!options.given(crushing_option, names)) {
    forbid_parts(options, crushing_option, names);
    return std::nullopt;
  }
  const double strength = options.real(crushing_option, names);
  const double stiffness = options.real(crushing_stiffness, names);
  Filler strip;
  strip.in_faces = true;
  strip.thickness = options.real(crushing_depth, names);
  if (!(strength / stiffness < strip.thickness)) {
    std::ostringstream text;
    text << "the strip is elastic for " << strength / stiffness
         << " m, its strength over its stiffness; give more";
    options.refuse(crushing_depth, names, text.str());
  }
  strip.table = {{strength / (stiffness * strip.thickness), strength}, {1, strength}};
  strip.unloading = stiffness * strip.thickness;
  if (options.given(crushing_area, names)) strip.area = options.real(crushing_area, names);
  return strip;
}

}  // namespace

std::optional<Filler> read_filler(OptionReader& options, const std::string& contact) {
  const OptionReader::Names names{contact};
  if (!options.given(filler_option, names) || options.text(filler_option, names) == "none") {
    forbid_parts(options, filler_option, names);
    return read_crushing(options, names);
  }
  options.forbid(crushing_option, names,
                 "not beside -" + option_name(filler_option, names) +
                     ": a joint has a filler, or faces that are crushed");
  forbid_parts(options, crushing_option, names);
  Filler filler;
  filler.table = read_filler_table(options, names);
  filler.unloading = options.real(unloading, names);
  if (filler.unloading < filler.steepest() * (1 - 1e-12)) {
    std::ostringstream text;
    text << "the table is steeper, " << filler.steepest() << " Pa somewhere";
    options.refuse(unloading, names, text.str());
  }
  if (options.given("<contact>_filler_thickness", names)) {
    filler.thickness = options.real("<contact>_filler_thickness", names);
  }
  if (options.given("<contact>_filler_area", names)) {
    filler.area = options.real("<contact>_filler_area", names);
  }
  return filler;
}

void check_filler(const OptionReader& options, const Contact& contact, bool exports) {
  const OptionReader::Names names{contact.name};
  const bool crushes = contact.crushes();
  const std::string owner = "contact " + contact.name + " has a ";
  if (contact.sliding > 0) {
    options.refuse(
        "<contact>_sliding", names,
        owner + (crushes ? "strip that is crushed" : "filler") + ", which stays where it is");
  }
  if (exports) {
    options.refuse("export_matrices", {},
                   owner + (crushes ? "strip" : "filler") + ", which is no matrix; not with -" +
                       option_name(crushes ? crushing_option : filler_option, names));
  }
  if (crushes && contact.friction > 0) {
    options.refuse("<contact>_friction", names,
                   "not beside -" + option_name(crushing_option, names) +
                       ": friction acts in hard contact only, which begins where the strip is "
                       "crushed to the last");
  }
}

}  // namespace pounding
