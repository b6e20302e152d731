#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pounding {

/// Lines of doubt about a scene as it was given: values outside the range of buildings, as they
/// come from a wrong unit (docs/reference/input-checks.md lists the ranges), and gravity that is
/// dropped on a structure that is held. Nothing is refused: models without units are as good.
std::vector<std::string> scene_doubts(const Scene& scene);

/// Whether clamps or grounded springs hold a structure along a direction (0-2).
bool is_held(const Structure& structure, std::size_t direction);

}  // namespace pounding
