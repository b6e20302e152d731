#pragma once

#include <string>
#include <vector>

/// Calls to the C library that pounding-mesh answers itself: the symbols of a program come before
/// those of its libraries, so that Gmsh's calls, and those of its parts, arrive here. Part of the
/// program pounding-mesh only.
namespace pounding {

/// Begins to note regular files that are opened for reading.
void note_opened_files();

/// Absolute paths of these files, as they were named, each once, in the order of their opening.
std::vector<std::string> opened_files();

}  // namespace pounding
