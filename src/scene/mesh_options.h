#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace pounding {

/// Options in force, with their values, that the cut meshes of a scene may depend on: all but those
/// that surely leave them as they are, and in place of those of the motion the directions in which
/// the scene is shaken. The files of the meshes count by their content, not by their names, and are
/// left out.
std::vector<std::pair<std::string, std::string>> mesh_options(
    const std::vector<std::pair<std::string, std::string>>& in_force, const Scene& scene);

}  // namespace pounding
