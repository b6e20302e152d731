#pragma once

#include <string>

#include "mesh/global_mesh.h"

namespace pounding::interactions {

/// Adds the forces by shapes in which nodes of a structure's absorbing bases part from the wave
/// from below, by a file of Scene::motion_incoherent (see motion/incoherent_wave.h), to those by
/// the wave. Throws UserError: a file that is none, a node of a base that it has not. Serial.
void add_wave_shapes(const std::string& file, const Structure& structure, GlobalMesh& mesh);

}  // namespace pounding::interactions
