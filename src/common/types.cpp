#include "common/types.h"

namespace pounding {

const char* element_name(ElementType type) {
  switch (type) {
    case ElementType::hex8:
      return "hex8";
    case ElementType::hex8_full:
      return "hex8_full";
    case ElementType::beam:
      return "beam";
    case ElementType::bar:
      return "bar";
    case ElementType::tension_bar:
      return "bar (tension only)";
    case ElementType::shell4:
      return "shell4";
    case ElementType::shell3:
      return "shell3";
    case ElementType::point_mass:
    case ElementType::point_mass6:
      return "point_mass";
    case ElementType::grounded_spring:
    case ElementType::grounded_spring6:
      return "grounded_spring";
    case ElementType::spring:
    case ElementType::spring6:
      return "spring";
  }
  return "";
}

}  // namespace pounding
