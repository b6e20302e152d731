#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "mesh/global_mesh.h"
#include "mesh/partition.h"

namespace pounding::testing_support {

/// Work and exchange of one part of a partition in a step.
struct PartLoad {
  std::int64_t dofs = 0;      ///< free ones of its own nodes
  std::int64_t elements = 0;  ///< held: all that touch a node of its own
  std::int64_t inner = 0;     ///< of these, with nodes of its own alone
  std::int64_t cost = 0;      ///< of these in a step, see measured_costs.h
  std::int64_t received = 0;  ///< free dofs of other parts' nodes that its elements touch
  std::int64_t sent = 0;      ///< its own free dofs, once per part that needs them
  std::int64_t messages = 0;  ///< sent, per structure one to each part that needs any
  std::int64_t neighbours = 0;
  std::int64_t sent_away = 0;      ///< of `sent`, to parts on other nodes of a cluster
  std::int64_t messages_away = 0;  ///< of `messages`
};

/// Dofs that parts of one structure send each other: from, to -> how many.
using Exchange = std::map<std::pair<int, int>, std::int64_t>;

/// Adds what parts exchange; `structures`: apart from each other, `cores`: parts on a node of a
/// cluster, which are numbered one after the other.
inline void add_exchange(std::span<const Exchange> structures, int cores,
                         std::vector<PartLoad>& loads) {
  std::set<std::pair<int, int>> neighbours;
  for (const Exchange& exchange : structures) {
    for (const auto& [pair, dofs] : exchange) {
      const auto& [from, to] = pair;
      loads[to].received += dofs;
      loads[from].sent += dofs;
      ++loads[from].messages;
      if (from / cores != to / cores) {
        loads[from].sent_away += dofs;
        ++loads[from].messages_away;
      }
      neighbours.insert({from, to});
      neighbours.insert({to, from});
    }
  }
  for (const auto& [part, other] : neighbours) ++loads[part].neighbours;
}

/// A node that a part needs and another one owns.
struct NeededNode {
  int part;
  GlobalIndex node;
  auto operator<=>(const NeededNode&) const = default;
};

/// Counts the elements that each part holds; returns the free nodes that parts need of each other.
inline std::vector<NeededNode> count_held(const GlobalMesh& mesh, const std::vector<int>& owner,
                                          std::vector<PartLoad>& loads) {
  std::vector<NeededNode> needed;
  std::vector<int> holders;
  for (const ElementSet& set : mesh.regions) {
    const ElementTraits& traits = traits_of(set.type);
    const auto width = static_cast<std::size_t>(traits.layout.nodes);
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      const std::span nodes(&set.connectivity[e * width], width);
      holders.clear();
      for (const GlobalIndex node : nodes) holders.push_back(owner[node]);
      std::ranges::sort(holders);
      holders.erase(std::unique(holders.begin(), holders.end()), holders.end());
      for (const int part : holders) {
        ++loads[part].elements;
        loads[part].cost += set.cost();
        if (holders.size() == 1) {
          ++loads[part].inner;
          continue;
        }
        for (const GlobalIndex node : nodes) {
          const bool is_ghost = owner[node] != part && mesh.free_components[node] != 0;
          if (is_ghost) needed.push_back({part, node});
        }
      }
    }
  }
  std::ranges::sort(needed);
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  return needed;
}

/// Loads of the parts of a partition; structures exchange apart from each other. `cores`: of a node
/// of a cluster. Serial.
inline std::vector<PartLoad> part_loads(std::span<const GlobalMesh> meshes,
                                        const Partition& partition,
                                        int cores = std::numeric_limits<int>::max()) {
  std::vector<PartLoad> loads(static_cast<std::size_t>(partition.parts));
  std::vector<Exchange> structures(meshes.size());
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const GlobalMesh& mesh = meshes[s];
    const std::vector<int>& owner = partition.node_owner[s];
    for (std::size_t n = 0; n < owner.size(); ++n) {
      loads[owner[n]].dofs += component_count(mesh.free_components[n]);
    }
    for (const NeededNode& one : count_held(mesh, owner, loads)) {
      structures[s][{owner[one.node], one.part}] += component_count(mesh.free_components[one.node]);
    }
  }
  add_exchange(structures, cores, loads);
  return loads;
}

}  // namespace pounding::testing_support
