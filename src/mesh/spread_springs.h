#pragma once

#include <cstdint>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// A group of springs that are spread over an area or along lines.
struct SpreadReport {
  const Region* region = nullptr;  ///< borrowed from the structure
  std::int64_t nodes = 0;
  double extent = 0;  ///< [m2] or [m]
};

/// The groups of a structure whose springs are spread, in the order of its regions.
std::vector<SpreadReport> find_spread_springs(const Structure& structure, const GlobalMesh& mesh);

}  // namespace pounding
