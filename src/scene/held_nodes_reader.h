#pragma once

#include <string>
#include <vector>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The supports of a structure: physical groups, each with the components that it loses if those
/// are not all of them, `mid:y+rx+rz`. Throws UserError.
std::vector<Clamp> read_clamps(OptionReader& options, const std::string& structure);

/// The groups of a structure that move together. Throws UserError if one is listed twice.
std::vector<RigidGroup> read_rigid_groups(OptionReader& options, const std::string& structure);

/// Makes the mat of a structure on soil rigid, unless it is already.
void make_mat_rigid(Structure& structure);

/// The absorbing faces of a structure. Throws UserError for a group listed twice, and beside
/// matrices or a reduction.
std::vector<AbsorbingFace> read_absorbing(OptionReader& options, const Structure& structure);

/// Throws UserError (one line) unless every structure can be moved the way that the scene says: all
/// on the ground that moves, or all by a wave from below, and nothing that its absorbing faces
/// alone would have to carry.
void check_absorbing(const OptionReader& options, const Scene& scene);

}  // namespace pounding
