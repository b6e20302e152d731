#pragma once

#include <limits>

namespace pounding::interactions {

/// Round-off of one operation on numbers near one.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Residual or bound of a problem without a finite one.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace pounding::interactions
