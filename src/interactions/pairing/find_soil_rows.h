#pragma once

#include <span>
#include <vector>

#include "interactions/pairing/interface.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Rows of the soil that mats of several structures share, of all files of such soil: all that acts
/// beside the springs that K of each structure has. The foundations are laid. Throws UserError
/// where a mat of a file is that of no structure or of two, where factors of the soil differ, and
/// for a structure of which a support moves a part. Serial, rank 0.
std::vector<SoilRow> find_soil_rows(const Scene& scene, std::span<const GlobalMesh> meshes);

}  // namespace pounding::interactions
