#pragma once

#include <string>
#include <vector>

#include "scene/option_table.h"

namespace pounding {

/// Takes every `-options_file FILE` out of the command line, before PETSc sees it, and returns the
/// files in their order. PETSc would stop with a traceback at a missing file or a YAML mistake.
std::vector<std::string> take_option_files(int& count, char** words);

/// The options of the command line (what PETSc has not used itself), then those of the files, the
/// later before the earlier, then those of the files that they `include`: who comes first wins.
/// Options meant for PETSc or SLEPc are passed on to them. Relative paths are relative to the
/// folder in which the program runs. Throws UserError (missing or unreadable file, files that
/// include each other). Collective over PETSC_COMM_WORLD.
OptionsDatabase read_options_database(const std::vector<std::string>& files);

}  // namespace pounding
