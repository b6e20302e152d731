#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/command_line.h"

namespace pounding {

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
