#include "scene/standard_materials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/option_values.h"

namespace pounding {
namespace {

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
