#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pounding {

/// Index on this rank (owned then ghost), and index over all ranks.
using LocalIndex = int;
using GlobalIndex = std::int64_t;

using Vector3 = std::array<double, 3>;

inline constexpr std::array<const char*, 3> direction_names{"x", "y", "z"};

/// Rigid motions and the components that a clamp may hold, as users write them: along and about x,
/// y, z.
inline constexpr std::array<std::string_view, 6> motion_names{"x", "y", "z", "rx", "ry", "rz"};

/// Components of a node's displacement as files name them: translations, then rotations.
inline constexpr std::array<std::string_view, 6> component_names{"ux", "uy", "uz",
                                                                 "rx", "ry", "rz"};

/// Names of things that have one.
std::vector<std::string> names_of(const auto& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

}  // namespace pounding
