#include "scene/unknown_options.h"

#include <algorithm>
#include <set>

#include "common/error.h"
#include "scene/nearest_name.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

using NameSet = std::set<std::string>;

/// Names X for which `X + tail` (behind `prefix`) is in the database.
NameSet defined_by(const OptionsDatabase& database, const std::string& prefix,
                   const std::string& tail) {
  NameSet names;
  for (const auto& [option, value] : database) {
    if (option.starts_with(prefix) && option.ends_with(tail) &&
        option.size() > prefix.size() + tail.size()) {
      names.insert(option.substr(prefix.size(), option.size() - prefix.size() - tail.size()));
    }
  }
  return names;
}

/// Every concrete option name that makes sense for what the database defines.
std::vector<std::string> sensible_names(const OptionsDatabase& database,
                                        const std::vector<std::string>& structures) {
  const NameSet materials = defined_by(database, "material_", "_young");
  const NameSet sections = defined_by(database, "section_", "_area");
  const NameSet contacts = defined_by(database, "", "_secondary");
  const NameSet probes = defined_by(database, "", "_structure");
  std::vector<std::string> names;
  const auto add = [&names](std::string_view pattern, const NameSet& owners) {
    for (const std::string& owner : owners) {
      names.push_back(option_name(pattern, {owner}));
    }
  };
  for (const OptionRow& row : option_table()) {
    switch (row.block) {
      case OptionBlock::run:
      case OptionBlock::spectra:
        names.emplace_back(row.pattern);
        break;
      case OptionBlock::structure:
        add(row.pattern, NameSet(structures.begin(), structures.end()));
        break;
      case OptionBlock::region:
        for (const std::string& structure : structures) {
          for (const std::string& group : defined_by(database, structure + "_", "_element")) {
            names.push_back(option_name(row.pattern, {structure, group}));
          }
        }
        break;
      case OptionBlock::material:
        add(row.pattern, materials);
        break;
      case OptionBlock::section:
        add(row.pattern, sections);
        break;
      case OptionBlock::contact:
        add(row.pattern, contacts);
        break;
      case OptionBlock::motion:
        add(row.pattern, {"x", "y", "z"});
        break;
      case OptionBlock::probe:
        add(row.pattern, probes);
        break;
    }
  }
  return names;
}

}  // namespace

void refuse_unknown_options(const OptionsDatabase& database,
                            const std::vector<std::string>& structures) {
  const std::vector<std::string> known = sensible_names(database, structures);
  const std::set<std::string> lookup(known.begin(), known.end());
  for (const auto& [option, value] : database) {
    if (lookup.contains(option) || is_petsc_option(option)) {
      continue;
    }
    const auto near = nearest_name(option, known);
    throw UserError("unknown option -" + option + " (value " + shown_value(value) + ")" +
                    (near ? "; did you mean -" + *near + "?" : "; see pounding -help"));
  }
}

}  // namespace pounding
