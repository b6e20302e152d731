#include "scene/standard_parts.h"

#include <cstdio>
#include <set>

#include "common/error.h"
#include "scene/nearest_name.h"
#include "scene/option_values.h"
#include "scene/standard_materials.h"
#include "scene/standard_sections.h"

namespace pounding {
namespace {

/// A number as an option: ten digits.
std::string option_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

/// Values of the options of regions that end with `tail`: names of their sections or materials.
std::set<std::string> named_by_regions(const OptionsDatabase& options, std::string_view tail) {
  std::set<std::string> names;
  for (const auto& [option, value] : options) {
    if (option.ends_with(tail)) names.insert(trimmed(value));
  }
  return names;
}

void add_section(OptionsDatabase& options, const std::string& name, const SectionNumbers& numbers) {
  const auto add = [&](std::string_view pattern, double number) {
    options.try_emplace(option_name(pattern, {name}), option_text(number));
  };
  add("section_<section>_area", numbers.area);
  add("section_<section>_inertia_y", numbers.inertia_y);
  add("section_<section>_inertia_z", numbers.inertia_z);
  add("section_<section>_torsion", numbers.torsion);
  options.try_emplace(option_name("section_<section>_shear_area", {name}),
                      option_text(numbers.shear_area_y) + "," + option_text(numbers.shear_area_z));
}

void add_profiles(const OptionsDatabase& given, OptionsDatabase& options) {
  constexpr std::string_view pattern = "section_<section>_profile";
  for (const auto& [option, value] : given) {
    const auto name = match_option(pattern, option);
    if (!name) continue;
    const std::string profile = trimmed(value);
    const auto numbers = standard_section(profile);
    if (!numbers) {
      throw UserError("option -" + option + " " + shown_value(value) + ": no standard section" +
                      standard_section_suggestion(profile) + "; expected " +
                      expected_text(option_row(pattern)));
    }
    add_section(options, *name, *numbers);
  }
}

}  // namespace

OptionsDatabase with_standard_parts(const OptionsDatabase& given) {
  OptionsDatabase options = given;
  add_profiles(given, options);
  for (const std::string& name : named_by_regions(given, "_section")) {
    if (const auto numbers = standard_section(name)) add_section(options, name, *numbers);
  }
  for (const std::string& name : named_by_regions(given, "_material")) {
    const auto numbers = standard_material(name);
    if (!numbers) continue;
    const auto add = [&](std::string_view pattern, double number) {
      options.try_emplace(option_name(pattern, {name}), option_text(number));
    };
    add("material_<material>_young", numbers->young);
    add("material_<material>_poisson", numbers->poisson);
    add("material_<material>_density", numbers->density);
  }
  return options;
}

std::string standard_section_suggestion(std::string_view name) {
  return suggestion(upper_case(name), standard_section_names());
}

std::string standard_material_suggestion(std::string_view name) {
  return suggestion(upper_case(name), standard_material_names());
}

}  // namespace pounding
