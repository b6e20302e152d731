#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/option_table.h"

namespace pounding {

/// Words behind the program's name.
struct CommandLine {
  bool help = false;               ///< -help, --help or -h
  std::string help_about;          ///< the word behind it
  bool help_json = false;          ///< -help_json
  bool version = false;            ///< -version or --version
  std::vector<std::string> files;  ///< of every -options_file, in their order
  OptionsDatabase options;         ///< all others; of two with the same name the last one

  /// It asks for a text, and for no run.
  bool asks() const { return help || help_json || version; }
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

/// Whence a scene is.
struct SceneOrigin {
  std::vector<std::string> files;  ///< of options, in the order in which they were read
  /// Options of the command line beside such files, by which the run is another one than the files
  /// say, with their values; those of the names and times of output are not.
  std::vector<std::pair<std::string, std::string>> overrides;
};

/// Origin of the scene of a command line; `files`: those that were read for it.
SceneOrigin origin_of(const CommandLine& line, const std::vector<std::string>& files);

/// One line for the reader: "with end_time 5, floor1_gap 0.03"; empty where nothing overrides.
std::string overrides_text(const SceneOrigin& origin);

}  // namespace pounding
