#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pounding {

/// Index on this rank (owned then ghost), and index over all ranks.
using LocalIndex = int;
using GlobalIndex = std::int64_t;

using Vector3 = std::array<double, 3>;

inline constexpr std::array<const char*, 3> direction_names{"x", "y", "z"};

/// The elements a scene can ask for; `hex8` is the one with incompatible modes.
enum class ElementType { hex8, hex8_full, beam, bar };

}  // namespace pounding
