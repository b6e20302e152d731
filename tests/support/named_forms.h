#pragma once

#include <array>
#include <string_view>

#include "stiffness/rows/product.h"

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
inline constexpr std::array named_forms{POUNDING_FORM(bricks), POUNDING_FORM(rectangles),
                                        POUNDING_FORM(strains), POUNDING_FORM(beams)};
#undef POUNDING_FORM
static_assert(named_forms.size() == sizeof(stiffness::ProductForms));

}  // namespace pounding::testing_support
