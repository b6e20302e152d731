#pragma once

#include "mesh/global_mesh.h"
#include "modal/modal_basis.h"
#include "modal/modal_basis_file.h"
#include "scene/scene.h"

namespace pounding {

/// Hashes of the sources of a modal basis, by their names: mesh, materials and sections, the
/// formulations of the elements, every byte of dofs.csv and of the matrices where they come from
/// files, clamps, how many vectors, and the points where the motion is asked for. Serial. Throws
/// UserError if a file cannot be read.
BasisKey basis_key(const Structure& structure, const GlobalMesh& mesh, const ModalRequest& request);

}  // namespace pounding
