#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Resolved options: all that `options` has read, defaults included, then those of PETSc and SLEPc.
OptionValues resolved_values(const OptionReader& options);

/// Resolved options as flat YAML: one `name: "value"` per line. Read back, it gives the same scene.
std::string resolved_yaml(const OptionValues& resolved);

/// Options in force, with their values, that the cut meshes of a scene may depend on: all but those
/// that surely leave them as they are, and in place of those of the motion the directions in which
/// the scene is shaken. The files of the meshes count by their content, not by their names, and are
/// left out.
OptionValues mesh_options(const OptionValues& in_force, const Scene& scene);

}  // namespace pounding
