#pragma once

#include <string>

#include "common/types.h"

namespace pounding {

/// A place as messages name it: (x, y, z) with six digits [m].
std::string place_text(const Vector3& place);

}  // namespace pounding
