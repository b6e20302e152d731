#pragma once

#include <optional>
#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The stop between nodes that a contact is, if `along` is given. Throws UserError on a direction
/// that is none, and on options of stops beside a contact of faces.
std::optional<Stop> read_stop(OptionReader& options, const std::string& contact);

/// Refuses options of faces beside a stop, gaps that it cannot have, friction where it gives way,
/// and matrices that would not hold it. `exports`: the run writes matrices.
void check_stop(const OptionReader& options, const Contact& contact, bool exports);

/// The point of a side "x,y,z" of a stop; nothing where the side is a group.
std::optional<Vector3> point_of_side(const std::string& side);

}  // namespace pounding
