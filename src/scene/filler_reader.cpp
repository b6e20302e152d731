#include "scene/filler_reader.h"

#include <sstream>
#include <string_view>

#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr std::string_view filler_option = "<contact>_filler";
constexpr std::string_view unloading = "<contact>_filler_unloading";

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

}  // namespace

std::optional<Filler> read_filler(OptionReader& options, const std::string& contact) {
  const OptionReader::Names names{contact};
  if (!options.given(filler_option, names) || options.text(filler_option, names) == "none") {
    for (const OptionRow& row : option_table()) {
      if (row.pattern.starts_with("<contact>_filler_")) {
        options.forbid(row.pattern, names,
                       "goes with -" + option_name(filler_option, names) + ", which is not given");
      }
    }
    return std::nullopt;
  }
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

}  // namespace pounding
