#pragma once

#include <array>
#include <cstdint>

namespace pounding {

/// Index on this rank (owned then ghost), and index over all ranks.
using LocalIndex = int;
using GlobalIndex = std::int64_t;

using Vector3 = std::array<double, 3>;

inline constexpr std::array<const char*, 3> direction_names{"x", "y", "z"};

}  // namespace pounding
