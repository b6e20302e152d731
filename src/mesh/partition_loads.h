#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/global_mesh.h"
#include "mesh/partition.h"

namespace pounding {

/// Work and exchange of one part of a partition in a step.
struct PartLoad {
  std::int64_t dofs = 0;      ///< free ones of its own nodes
  std::int64_t elements = 0;  ///< held: all that touch a node of its own
  std::int64_t cost = 0;      ///< of these in a step, see measured_costs.h
  std::int64_t received = 0;  ///< free dofs of other parts' nodes that its elements touch
  std::int64_t sent = 0;      ///< its own free dofs, once per part that needs them
  std::int64_t messages = 0;  ///< sent, per structure one to each part that needs any
  std::int64_t neighbours = 0;
};

/// Loads of the parts of a partition; structures exchange apart from each other. `whole` as in
/// partition_meshes(): of a structure that is not cut its dofs count, and no elements, which
/// reduced structures do not have. Serial.
std::vector<PartLoad> part_loads(std::span<const GlobalMesh> meshes, const Partition& partition,
                                 std::span<const int> whole = {});

}  // namespace pounding
