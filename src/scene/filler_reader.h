#pragma once

#include <optional>
#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The filler of a contact's joint, or the strip of its faces to crush, if it has one. Throws
/// UserError on a table that is none, falls, or is steeper than the unloading slope, on a strip
/// that is all elastic, and on both together.
std::optional<Filler> read_filler(OptionReader& options, const std::string& contact);

/// Refuses faces that slide, matrices that would not hold the filler or the strip, and friction
/// beside a strip. `exports`: the run writes matrices.
void check_filler(const OptionReader& options, const Contact& contact, bool exports);

}  // namespace pounding
