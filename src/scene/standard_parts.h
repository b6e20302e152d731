#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/option_table.h"

namespace pounding {

/// The options, with those of the standard sections and materials that they name and that the user
/// did not give himself: whose own option there is wins. A section takes the numbers of its
/// `profile`, or if it has none those of its name. Throws UserError for a profile that is no
/// standard section.
OptionsDatabase with_standard_parts(const OptionsDatabase& given);

/// "; did you mean HEB160?" of the standard sections and materials, or "".
std::string standard_section_suggestion(std::string_view name);
std::string standard_material_suggestion(std::string_view name);

struct MaterialNumbers {
  double young = 0;    ///< Young's modulus [Pa]
  double poisson = 0;  ///< Poisson's ratio [-]
  double density = 0;  ///< [kg/m3]
};

/// Numbers of a usual material by its name, in any case. Steel of S235 to S460: EN 1993-1-1, 3.2.6,
/// 210 GPa; of A36, A500, A572, A992: AISC 360, 200 GPa. Concrete of C12/15 to C90/105, also C12 to
/// C90: the secant modulus of EN 1992-1-1, table 3.1, 22 GPa ((fck + 8 MPa) / 10 MPa)^0.3,
/// uncracked, with 2500 kg/m3 for the reinforced. Nothing if there is none of that name.
std::optional<MaterialNumbers> standard_material(std::string_view name);

/// Names of them all.
std::vector<std::string> standard_material_names();

}  // namespace pounding
