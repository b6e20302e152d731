#pragma once

#include <array>
#include <string_view>

namespace pounding {

/// Rigid motions and the components that a clamp may hold, as users write them: along and about x,
/// y, z.
inline constexpr std::array<std::string_view, 6> motion_names{"x", "y", "z", "rx", "ry", "rz"};

/// Components of a node's displacement as files name them: translations, then rotations.
inline constexpr std::array<std::string_view, 6> component_names{"ux", "uy", "uz",
                                                                 "rx", "ry", "rz"};

}  // namespace pounding
