#pragma once

#include <cstdint>

namespace pounding {

/// Rotations about x, y, z in the bits of a node's components.
inline constexpr std::uint8_t rotations = 0x38;

}  // namespace pounding
