#pragma once

#include <cstdint>
#include <span>

#include "interactions/pairing/interface.h"
#include "mesh/global_mesh.h"
#include "mesh/partition.h"
#include "scene/scene.h"

namespace pounding {

/// Loads of the ranks of a partition, whether they are there or not.
struct RankLoads {
  int ranks = 1;
  double imbalance = 1;             ///< as in Partition
  double mean_dofs = 0;             ///< free dofs of a rank
  std::int64_t dofs = 0;            ///< this and all that follow are the largest of one rank
  std::int64_t held_dofs = 0;       ///< with those of other ranks that its elements touch
  std::int64_t elements = 0;        ///< held, those at cuts on every side
  std::int64_t cost = 0;            ///< of these in a step, see measured_costs.h
  std::int64_t exchanged = 0;       ///< dofs sent or received in a step, whichever are more
  std::int64_t messages = 0;        ///< sent in a step
  int interface_ranks = 0;          ///< that hold a dof of a contact
  std::int64_t interface_dofs = 0;  ///< of all contacts' rows
  std::int64_t all_held_dofs = 0;   ///< sum over the ranks
};

/// Loads now and on the ranks of -predict_ranks. On rank 0.
struct ForeseenLoads {
  RankLoads now;
  RankLoads then;
};

/// Loads of the ranks of a partition of the whole meshes. Rank 0.
RankLoads loads_of_ranks(const Scene& scene, std::span<const GlobalMesh> meshes,
                         const interactions::Interface& interface, const Partition& partition);

}  // namespace pounding
