#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace pounding {

/// The words of a geometry in Gmsh's language and of all files that it includes or merges: its
/// parameters are among them.
struct GeometryWords {
  std::set<std::string> words;
};

/// Whether Gmsh parses a file as a geometry in its own language (.geo).
bool is_geometry(const std::filesystem::path& file);

/// Files that a geometry includes or merges, and those that these do, in the order of the text:
/// none of a file that is no geometry or cannot be read, none whose name is computed.
std::vector<std::filesystem::path> files_included_in(const std::filesystem::path& file);

/// Looks at a mesh or geometry before Gmsh does, which runs the commands of any file that it does
/// not know as something else. Throws UserError, with `option` at its head, where the file is
/// missing, of no kind that is known, or, unless `allow_commands`, can run commands or write files:
/// itself, by a file that it includes or merges, or by one whose name cannot be known beforehand.
GeometryWords inspect_mesh_file(const std::string& option, const std::filesystem::path& file,
                                bool allow_commands);

}  // namespace pounding
