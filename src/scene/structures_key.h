#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pounding {

/// A key of the structures of a scene: equal keys are the same meshes, elements, materials,
/// sections, supports, damping and contact faces under the same names. Gaps, ground motion, probes
/// and how a structure is represented (reduced, with scaled mass) are left out. `in_force`: names
/// and values of the options, presets of structures left out; of a mesh file the size and the first
/// megabyte count, not its name. Reads the files that are there.
std::string structures_key(const std::vector<std::pair<std::string, std::string>>& in_force);

}  // namespace pounding
