#pragma once

#include <vector>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The absorbing faces of a structure. Throws UserError for a group listed twice, and beside
/// matrices or a reduction.
std::vector<AbsorbingFace> read_absorbing(OptionReader& options, const Structure& structure);

/// Throws UserError (one line) unless every structure can be moved the way that the scene says: all
/// on the ground that moves, or all by a wave from below, and nothing that its absorbing faces
/// alone would have to carry.
void check_absorbing(const OptionReader& options, const Scene& scene);

}  // namespace pounding
