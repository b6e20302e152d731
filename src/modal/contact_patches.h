#pragma once

#include <span>
#include <vector>

#include "common/types.h"
#include "system/linear_system.h"

namespace pounding {

/// Patches of contact points, as numbers of points: together `count` of them, or one more for each
/// axis along which points move, shared out by the number of points of each axis. Their middles are
/// points as far from each other as can be found one after the other (Gonzalez, Theor. Comput. Sci.
/// 38 (1985) 293); a point belongs to the nearest one. `positions`: of each point [m]. Serial; the
/// same for the same points.
std::vector<std::vector<std::size_t>> contact_patches(std::span<const TracePoint> points,
                                                      std::span<const Vector3> positions,
                                                      std::size_t count);

}  // namespace pounding
