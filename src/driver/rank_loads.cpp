#include "driver/rank_loads.h"

#include <algorithm>
#include <vector>

#include "mesh/partition_loads.h"

namespace pounding {

RankLoads loads_of_ranks(const Scene& scene, std::span<const GlobalMesh> meshes,
                         const interactions::Interface& interface, const Partition& partition) {
  std::vector<int> whole;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const bool reduced = scene.structures[s].modal.has_value();
    whole.push_back(reduced && !partition.node_owner[s].empty() ? partition.node_owner[s][0] : -1);
  }
  RankLoads loads;
  loads.ranks = partition.parts;
  loads.imbalance = partition.imbalance;
  for (const PartLoad& part : part_loads(meshes, partition, whole)) {
    loads.mean_dofs += static_cast<double>(part.dofs) / partition.parts;
    loads.dofs = std::max(loads.dofs, part.dofs);
    loads.held_dofs = std::max(loads.held_dofs, part.dofs + part.received);
    loads.all_held_dofs += part.dofs + part.received;
    loads.elements = std::max(loads.elements, part.elements);
    loads.cost = std::max(loads.cost, part.cost);
    loads.exchanged = std::max({loads.exchanged, part.sent, part.received});
    loads.messages = std::max(loads.messages, part.messages);
  }
  std::vector<char> has_dof(static_cast<std::size_t>(partition.parts), 0);
  for (const interactions::Constraint& row : interface.constraints) {
    for (const interactions::ConstraintTerm& term : row.terms) {
      has_dof[partition.node_owner[term.structure][term.node]] = 1;
      ++loads.interface_dofs;
    }
  }
  loads.interface_ranks = static_cast<int>(std::ranges::count(has_dof, 1));
  return loads;
}

}  // namespace pounding
