#pragma once

#include <optional>
#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The gap of a contact of the name: values, random part, and patches. Throws UserError on values
/// that it cannot have, by their count or of a wall without one.
InitialGap read_gap(OptionReader& options, const std::string& contact, bool is_wall);

/// The filler of a contact's joint, or the strip of its faces to crush, if it has one. Throws
/// UserError on a table that is none, falls, or is steeper than the unloading slope, on a strip
/// that is all elastic, and on both together.
std::optional<Filler> read_filler(OptionReader& options, const std::string& contact);

/// Refuses faces that slide, matrices that would not hold the filler or the strip, and friction
/// beside a strip. `exports`: the run writes matrices.
void check_filler(const OptionReader& options, const Contact& contact, bool exports);

/// The stop between nodes that a contact is, if `along` is given. Throws UserError on a direction
/// that is none, and on options of stops beside a contact of faces.
std::optional<Stop> read_stop(OptionReader& options, const std::string& contact);

/// Refuses options of faces beside a stop, gaps that it cannot have, friction where it gives way,
/// and matrices that would not hold it. `exports`: the run writes matrices.
void check_stop(const OptionReader& options, const Contact& contact, bool exports);

/// The point "x,y,z" of a text; nothing where it is none, as the name of a group.
std::optional<Vector3> point_of_side(const std::string& side);

}  // namespace pounding
