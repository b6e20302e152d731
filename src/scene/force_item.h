#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/types.h"

namespace pounding {

/// Forces that a run records.
enum class ForceKind : std::uint8_t {
  reactions,  ///< what the ground does to a structure, three forces and three moments
  storey,     ///< likewise what passes through a level
  members     ///< of beams, bars and springs, at their ends
};

/// An item of the option `forces`.
struct ForceItem {
  std::string name;
  std::string structure;
  ForceKind kind = ForceKind::reactions;
  double level = 0;                ///< of a storey: z [m]
  std::optional<Vector3> about{};  ///< moments are about this point [m]; nothing: see `point`
  std::string group;               ///< of members
  std::vector<Vector3> points;     ///< elements nearest to these only [m]; empty: all of the group

  /// Point of the moments [m]: of a storey on its level unless told otherwise.
  Vector3 point() const {
    return about.value_or(kind == ForceKind::storey ? Vector3{0, 0, level} : Vector3{0, 0, 0});
  }
};

}  // namespace pounding
