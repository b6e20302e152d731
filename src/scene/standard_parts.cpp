#include "scene/standard_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "common/error.h"
#include "scene/option_values.h"
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

constexpr std::array<std::string_view, 5> european_steels{"S235", "S275", "S355", "S420", "S460"};
constexpr std::array<std::string_view, 4> american_steels{"A36", "A500", "A572", "A992"};

/// Characteristic strength of cylinders [MPa], and the longer name with that of cubes.
struct Concrete {
  int strength;
  std::string_view name;
};
constexpr std::array<Concrete, 14> concretes{
    Concrete{12, "C12/15"}, Concrete{16, "C16/20"}, Concrete{20, "C20/25"}, Concrete{25, "C25/30"},
    Concrete{30, "C30/37"}, Concrete{35, "C35/45"}, Concrete{40, "C40/50"}, Concrete{45, "C45/55"},
    Concrete{50, "C50/60"}, Concrete{55, "C55/67"}, Concrete{60, "C60/75"}, Concrete{70, "C70/85"},
    Concrete{80, "C80/95"}, Concrete{90, "C90/105"}};

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

std::optional<MaterialNumbers> standard_material(std::string_view name) {
  const std::string upper = upper_case(name);
  if (std::ranges::find(european_steels, upper) != european_steels.end()) {
    return MaterialNumbers{210e9, 0.3, 7850};
  }
  if (std::ranges::find(american_steels, upper) != american_steels.end()) {
    return MaterialNumbers{200e9, 0.3, 7850};
  }
  for (const Concrete& concrete : concretes) {
    if (upper == concrete.name || upper == "C" + std::to_string(concrete.strength)) {
      return MaterialNumbers{22e9 * std::pow((concrete.strength + 8) / 10.0, 0.3), 0.2, 2500};
    }
  }
  return std::nullopt;
}

std::vector<std::string> standard_material_names() {
  std::vector<std::string> names(european_steels.begin(), european_steels.end());
  names.insert(names.end(), american_steels.begin(), american_steels.end());
  for (const Concrete& concrete : concretes) {
    names.push_back("C" + std::to_string(concrete.strength));
    names.emplace_back(concrete.name);
  }
  return names;
}

}  // namespace pounding
