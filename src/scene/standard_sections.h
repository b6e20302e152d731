#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/section_shapes.h"

namespace pounding {

/// Numbers of a standard section by its name, in any case: IPE, HEA, HEB, HEM, UPN (HEB160, also
/// HE160B), W (W14x132), and tubes of any size that is one: SHS100x5, RHS200x100x8, CHS168.3x6 in
/// mm, HSS8x8x1/2, HSS8x4x3/8 in inches; solid ones of any size: RECT600x400, ROUND50 in mm.
/// Nothing if there is none of that name.
std::optional<SectionNumbers> standard_section(std::string_view name);

/// Names of the sections that have rows of their own: all but tubes and solid ones.
std::vector<std::string> standard_section_names();

}  // namespace pounding
