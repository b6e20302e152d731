#pragma once

#include <string>

#include "mesh/raw_mesh.h"

namespace pounding {

/// Lets the Gmsh library open a mesh, or `make` one of a geometry, and takes over what it holds.
/// Errors that Gmsh reports come as the answer's; its crashes end the process. Part of the program
/// pounding-mesh only.
RawAnswer gmsh_mesh(const std::string& file, bool make);

}  // namespace pounding
