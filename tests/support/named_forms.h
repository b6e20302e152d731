#pragma once

#include <array>
#include <string_view>

#include "stiffness/rows/product_forms.h"

namespace pounding::testing_support {

/// A form by its name in ProductForms.
struct NamedForm {
  std::string_view name;
  bool stiffness::ProductForms::*form;
};

#define POUNDING_FORM(name)               \
  NamedForm {                             \
#name, &stiffness::ProductForms::name \
  }
inline constexpr std::array named_forms{
    POUNDING_FORM(bricks),         POUNDING_FORM(rectangles), POUNDING_FORM(strains),
    POUNDING_FORM(beams),          POUNDING_FORM(best_axis),  POUNDING_FORM(hand_over),
    POUNDING_FORM(best_thickness), POUNDING_FORM(both_sides), POUNDING_FORM(lent_lines),
    POUNDING_FORM(row_pairs),      POUNDING_FORM(rows),       POUNDING_FORM(part_cores),
    POUNDING_FORM(set_behind),     POUNDING_FORM(set_joins),  POUNDING_FORM(shell_vectors)};
#undef POUNDING_FORM
static_assert(named_forms.size() == sizeof(stiffness::ProductForms));

}  // namespace pounding::testing_support
