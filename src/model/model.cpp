#include "model/model.h"

#include "mesh/location.h"
#include "modal/reduced_system.h"

namespace pounding {

std::string Building::locate_largest(std::span<const double> values) const {
  return basis ? pounding::locate_largest(*system, *basis, values)
               : pounding::locate_largest(*mesh, values);
}

}  // namespace pounding
