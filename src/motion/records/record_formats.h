#pragma once

#include <span>

#include "motion/records/record_format.h"

namespace pounding {

/// All formats that have a reader of their own, in the order in which they are tried.
std::span<const RecordFormat> record_formats();

/// The format of a file, null where none recognises it.
const RecordFormat* format_of(std::span<const TextLine> lines);

}  // namespace pounding
