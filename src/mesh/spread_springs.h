#pragma once

#include <cstdint>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// A group of springs that are spread over an area or along lines.
struct SpreadReport {
  std::int32_t region = 0;  ///< index into those of the structure
  std::int64_t nodes = 0;
  double extent = 0;  ///< [m2] or [m]
};

/// The groups of a structure whose springs are spread, in the order of its regions.
std::vector<SpreadReport> find_spread_springs(const GlobalMesh& mesh);

}  // namespace pounding
