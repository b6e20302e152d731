#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/option_table.h"

namespace pounding {

/// Words behind the program's name.
struct CommandLine {
  bool help = false;               ///< -help, --help or -h
  bool version = false;            ///< -version or --version
  std::vector<std::string> files;  ///< of every -options_file, in their order
  OptionsDatabase options;         ///< all others; of two with the same name the last one
};

/// Reads the words after the program's name: `-name value`, or `-name` alone for a flag; a value
/// may be a negative number. Where help or the version is asked for, nothing else is read. Throws
/// UserError for a word that is neither a name nor a value, for
/// `-name=value`, and for -options_file without a file.
CommandLine read_command_line(std::span<const std::string> words);

/// Text that -version prints: program, version and commit, then compiler and libraries.
std::string version_text();

/// One line for each variable of the environment in which PETSc would look for options and which is
/// set: the program does not read them.
std::vector<std::string> ignored_variables();

}  // namespace pounding
