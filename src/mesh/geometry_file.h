#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

namespace pounding {

/// Whether Gmsh parses a file as a geometry in its own language (.geo).
bool is_geometry(const std::filesystem::path& file);

/// Looks at a mesh or geometry before Gmsh does. Throws UserError, with `option` at its head, where
/// the file is missing, or is of no kind that is known.
void check_mesh_file(const std::string& option, const std::filesystem::path& file);

/// Looks at the files that Gmsh opened for a mesh: throws UserError where one lists two elements
/// under one number, or is a geometry of one line without an end, which Gmsh passes over.
void check_opened_files(const std::string& option, std::span<const std::string> files);

/// Words of the geometries among some files in Gmsh's language, without comments and texts between
/// quotes: their parameters are among them.
std::set<std::string> geometry_words(std::span<const std::string> files);

}  // namespace pounding
