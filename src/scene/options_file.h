#pragma once

#include <string>

#include "scene/option_table.h"

namespace pounding {

/// The options in the YAML text of a file. Names of nested mappings join with `_`; the items of a
/// sequence join with commas; a value is its text ("" where none is given: a flag). `<<` merges the
/// mapping of an anchor, whose names yield to those beside it; names that begin with `$$` only hold
/// anchors. Throws UserError with file, line and column: not YAML, no options, a second document, a
/// name given twice (with both lines), a nested sequence.
OptionsDatabase parse_options_file(const std::string& text, const std::string& file);

}  // namespace pounding
