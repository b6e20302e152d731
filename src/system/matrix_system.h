#pragma once

#include <string>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// A structure from matrices that another code made: `structure.matrices` is a folder with
///
///     dofs.csv        one line per row of the matrices: x, y, z [m], component (ux ... rz), and
///                     as one likes a label of the node, which messages and exports repeat
///     stiffness.mtx   K [N/m, N, N m]
///     mass.mtx        M [kg, kg m2]: a column of lumped masses, or a matrix, which is then lumped
///     by
///                     the sums of its rows over each component
///     damping.mtx     optional: D beside alpha M + beta K [N s/m]
///
/// each .mtx, or the same name with .petsc in PETSc's binary format. The mesh says where faces and
/// probes are and which nodes are clamped: rows find their dofs by position and component; rows of
/// clamped dofs are left out. Stiffness and damping are checked entry by entry as far as that shows
/// whether some motion has negative energy; the rest is require_passive_matrices' in modal/. Throws
/// UserError on every rank alike. Collective.
LinearSystem build_matrix_system(const Structure& structure, const Mesh& mesh);

/// The file of a matrix ("stiffness", "mass", "damping") in such a folder; empty if there is none.
/// Throws UserError if there are two.
std::string matrix_file(const std::string& folder, const std::string& name);

}  // namespace pounding
