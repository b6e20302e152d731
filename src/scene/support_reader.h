#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// A part of the ground that moves otherwise than the scene's motion says, with its own motion.
/// Throws UserError.
Support read_support(OptionReader& options, const std::string& name);

/// Refuses supports that name no structure of the scene, that list a group twice, whose delay or
/// factor has no effect, and that are not combined with the rest of the scene. Throws UserError.
void check_supports(const OptionReader& options, const Scene& scene);

/// The axis, 0-2, along which waves move the ground that bring a component of a foundation's motion
/// with them: its own of a displacement, the level one across of a rotation about x or y.
std::size_t axis_of_motion(std::size_t component);

/// Whether a support moves otherwise than the ground in a component, 0-2 along x, y, z and 3-5
/// about them; `ground_moves`: along the axis of that motion.
bool moves_otherwise(const Support& support, std::size_t component, bool ground_moves);

/// The support with which all ground of a structure moves: its clamped nodes, and the ground of its
/// springs, dashpots and soil; -1 if there is none. Index into the scene's supports.
int support_of_all_ground(const Scene& scene, const Structure& structure);

/// Whether a structure is on a support that moves otherwise than the ground.
bool stands_on_moving_support(const Scene& scene, const Structure& structure);

}  // namespace pounding
