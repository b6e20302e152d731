#pragma once

#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Doubts about beams without flexibility in shear where shear makes a member more flexible
/// by 5 % or more: one line for each region, with its worst member. Serial, rank 0.
std::vector<std::string> shear_doubts(const Structure& structure, const GlobalMesh& mesh);

}  // namespace pounding
