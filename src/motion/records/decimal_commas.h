#pragma once

#include <string>
#include <vector>

#include "motion/records/record_text.h"

namespace pounding {

/// Writes the numbers of a record with decimal points where they have decimal commas: one column
/// (0,25), or several that semicolons, blanks or tabs separate (0,02;-0,25). A single comma per
/// line may also separate two columns of whole numbers: decimals that begin with a zero, "-0" and
/// the like decide, then names with a comma between them, a `column` that is asked for, and first
/// numbers that increase. Returns whether commas were decimal. Throws UserError when nothing
/// decides.
bool replace_decimal_commas(const std::string& file, int column, std::vector<TextLine>& lines);

}  // namespace pounding
