#pragma once

#include <string>

#include <mpi.h>

#include "scene/command_line.h"
#include "scene/option_table.h"

namespace pounding {

/// The options of the command line, then those of its files, the later before the earlier, then
/// those of the files that they `include`: the first wins. Rank 0 reads the files, every rank gets
/// their text. In such a file, paths of input files are relative to the folder of the file if
/// something of that name is there, else to the folder in which the program runs. Throws UserError
/// on every rank alike (missing or unreadable file, refusals of parse_options_file, files that
/// include each other). `files`: unless null, the files that were read are appended to it.
/// Collective.
OptionsDatabase read_options_database(MPI_Comm comm, const CommandLine& line,
                                      std::vector<std::string>* files = nullptr);

/// Finds the files that options of a file name beside it: their values become paths that the
/// program can open. Collective.
void find_inputs(MPI_Comm comm, const std::string& file, OptionsDatabase& options);

/// The options in it that are meant for PETSc and SLEPc.
OptionsDatabase petsc_options(const OptionsDatabase& database);

/// The options in the YAML text of a file. Names of nested mappings join with `_`; the items of a
/// sequence join with commas; a value is its text ("" where none is given: a flag). `<<` merges the
/// mapping of an anchor, whose names yield to those beside it; names that begin with `$$` only hold
/// anchors. Throws UserError with file, line and column: not YAML, no options, a second document, a
/// name given twice (with both lines), a nested sequence.
OptionsDatabase parse_options_file(const std::string& text, const std::string& file);

}  // namespace pounding
