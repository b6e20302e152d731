#pragma once

#include <optional>
#include <string>

#include "scene/filler.h"
#include "scene/option_reader.h"

namespace pounding {

/// The filler of a contact's joint, or the strip of its faces to crush, if it has one. Throws
/// UserError on a table that is none, falls, or is steeper than the unloading slope, on a strip
/// that is all elastic, and on both together.
std::optional<Filler> read_filler(OptionReader& options, const std::string& contact);

}  // namespace pounding
