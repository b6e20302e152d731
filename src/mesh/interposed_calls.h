#pragma once

#include <string>
#include <vector>

/// Calls to the C library that pounding-mesh answers itself, to know which files Gmsh reads: no
/// guard tells that. The symbols of a program come before those of its libraries, so that the calls
/// of Gmsh and of its parts arrive here. Part of the program pounding-mesh only.
namespace pounding {

/// Begins to note regular files that are opened for reading; others, which may have no end, are not
/// opened any more.
void note_opened_files();

/// Absolute paths of these files, as they were named, each once, in the order of their opening.
std::vector<std::string> opened_files();

}  // namespace pounding
