#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Actions of the water of a pool, each a region of its structure.
enum class WaterPart : std::uint8_t {
  impulsive,   ///< masses on the nodes of the walls, or of the floor along z
  convective,  ///< masses of the waves, one node each
  wave,        ///< springs from one of these to the walls
  dashpot      ///< dashpots beside these, one to each wall
};

/// Region of water, and the direction (0-2) in which it acts.
struct WaterRegion {
  WaterPart part = WaterPart::impulsive;
  std::size_t direction = 0;
  int mode = 0;  ///< of a wave or its dashpots, from 0
};

/// Regions of each pool, in their order among those of its structure; none of one with cells.
std::vector<WaterRegion> water_regions(const Pool& pool);

std::vector<Pool> read_pools(OptionReader& options, std::span<const std::string> names);

/// Gives a structure its own of the pools, and their regions, as yet without masses and springs.
/// Throws UserError: beside matrices, a group that is named twice, uniform damping that takes its
/// reference from the first mode, which is a wave.
void take_pools(const OptionReader& options, std::span<const Pool> pools, Structure& structure);

/// Damping ratio of a wave of a circular frequency [rad/s] in a pool of a structure: that of the
/// pool, or the one by uniform damping if that is more.
double wave_damping(const Structure& structure, const Pool& pool, double omega);

/// Gives the regions of a structure's pools their masses, springs and dampings, once the mesh shows
/// the outlines.
void fill_pools(std::span<const PoolOutline> outlines, Structure& structure);

}  // namespace pounding
