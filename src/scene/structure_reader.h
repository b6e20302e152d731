#pragma once

#include <string>
#include <string_view>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// A structure with its regions (in alphabetical order of their groups), materials and sections.
/// Throws UserError.
Structure read_structure(OptionReader& options, const std::string& name);

/// The structure of the scene that an option names. Throws UserError naming the nearest one, with a
/// `hint` behind it.
const Structure& named_structure(const OptionReader& options, const Scene& scene,
                                 std::string_view pattern, const OptionReader::Names& names,
                                 const std::string& structure, const std::string& hint = "");

/// Makes points "x,y,z; ..." in place of a group, of a side of a stop or of a load, a group of that
/// name; does nothing about the name of a group.
void group_points(Scene& scene, const std::string& option, const std::string& structure,
                  const std::string& place);

}  // namespace pounding
