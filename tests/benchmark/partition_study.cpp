// What METIS makes of the pair of buildings of storey_pair.h for any number of parts, none of which
// is run: loads, halos, neighbours, contact gather. Serial.
//
//   partition_study CELLS_PER_METRE PARTS...
//
// Prints a line of JSON per number of parts.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmark/storey_pair.h"
#include "mesh/partition.h"

namespace pounding::measuring {
namespace {

using Json = nlohmann::ordered_json;

/// What one part computes and exchanges in a step.
struct PartLoad {
  long dofs = 0;      ///< owned
  long elements = 0;  ///< held: all that touch an owned node
  long received = 0;  ///< ghost dofs
  long sent = 0;      ///< owned dofs, once per part that needs them
  std::set<int> neighbours;
  long messages = 0;      ///< sent
  long contact_dofs = 0;  ///< owned dofs of the interface
};

/// A node that a part needs and another one owns.
struct Ghost {
  int part;
  GlobalIndex node;
  auto operator<=>(const Ghost&) const = default;
};

/// Counts owned dofs and held elements; returns the free nodes that parts need of each other.
std::vector<Ghost> count_own(const GlobalMesh& mesh, const std::vector<int>& owner,
                             std::vector<PartLoad>& loads) {
  constexpr std::size_t corners = 8;
  for (std::size_t n = 0; n < owner.size(); ++n) {
    loads[static_cast<std::size_t>(owner[n])].dofs += component_count(mesh.free_components[n]);
  }
  std::vector<Ghost> ghosts;
  const ElementSet& body = mesh.regions[0];
  for (std::size_t e = 0; e < body.tags.size(); ++e) {
    const std::span nodes(&body.connectivity[e * corners], corners);
    std::set<int> holders;
    for (const GlobalIndex node : nodes) {
      holders.insert(owner[static_cast<std::size_t>(node)]);
    }
    for (const int part : holders) {
      ++loads[static_cast<std::size_t>(part)].elements;
      for (const GlobalIndex node : nodes) {
        const auto n = static_cast<std::size_t>(node);
        if (owner[n] != part && mesh.free_components[n] != 0) {
          ghosts.push_back({part, node});
        }
      }
    }
  }
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  return ghosts;
}

/// What the parts of one building compute and exchange; buildings exchange apart from each other.
void add_structure(const GlobalMesh& mesh, const std::vector<int>& owner,
                   std::vector<PartLoad>& loads) {
  std::set<std::pair<int, int>> messages;
  for (const Ghost& ghost : count_own(mesh, owner, loads)) {
    const auto n = static_cast<std::size_t>(ghost.node);
    const int dofs = component_count(mesh.free_components[n]);
    PartLoad& receiver = loads[static_cast<std::size_t>(ghost.part)];
    PartLoad& sender = loads[static_cast<std::size_t>(owner[n])];
    receiver.received += dofs;
    receiver.neighbours.insert(owner[n]);
    sender.sent += dofs;
    sender.neighbours.insert(ghost.part);
    messages.insert({owner[n], ghost.part});
  }
  for (const auto& [from, to] : messages) {
    ++loads[static_cast<std::size_t>(from)].messages;
  }
}

Json spread(const std::vector<PartLoad>& loads, long (*value)(const PartLoad&)) {
  long largest = 0;
  long total = 0;
  for (const PartLoad& load : loads) {
    largest = std::max(largest, value(load));
    total += value(load);
  }
  return {{"largest", largest},
          {"mean", static_cast<double>(total) / static_cast<double>(loads.size())}};
}

Json describe(const std::vector<PartLoad>& loads) {
  Json json;
  json["dofs_per_part"] = spread(loads, [](const PartLoad& load) { return load.dofs; });
  json["elements_per_part"] = spread(loads, [](const PartLoad& load) { return load.elements; });
  json["received"] = spread(loads, [](const PartLoad& load) { return load.received; });
  json["sent"] = spread(loads, [](const PartLoad& load) { return load.sent; });
  json["neighbours"] =
      spread(loads, [](const PartLoad& load) { return static_cast<long>(load.neighbours.size()); });
  json["messages"] = spread(loads, [](const PartLoad& load) { return load.messages; });
  json["contact_dofs_per_part"] =
      spread(loads, [](const PartLoad& load) { return load.contact_dofs; });
  json["contact_members"] = std::count_if(
      loads.begin(), loads.end(), [](const PartLoad& load) { return load.contact_dofs > 0; });
  return json;
}

Json study(const StoreyPair& pair, int parts) {
  const auto start = std::chrono::steady_clock::now();
  const Partition partition =
      partition_meshes(pair.meshes, interactions::facing_nodes(pair.interface), parts);
  const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - start;
  std::vector<PartLoad> loads(static_cast<std::size_t>(parts));
  long dofs = 0;
  std::size_t elements = 0;
  for (std::size_t s = 0; s < pair.meshes.size(); ++s) {
    add_structure(pair.meshes[s], partition.node_owner[s], loads);
    elements += pair.meshes[s].regions[0].tags.size();
  }
  for (const interactions::Constraint& constraint : pair.interface.constraints) {
    for (const interactions::ConstraintTerm& term : constraint.terms) {
      const int owner = partition.node_owner[static_cast<std::size_t>(term.structure)]
                                            [static_cast<std::size_t>(term.node)];
      ++loads[static_cast<std::size_t>(owner)].contact_dofs;
    }
  }
  for (const PartLoad& load : loads) {
    dofs += load.dofs;
  }
  Json json{{"parts", parts},
            {"dofs", dofs},
            {"elements", elements},
            {"contact_rows", pair.interface.constraints.size()},
            {"edge_cut", partition.edge_cut},
            {"cost_imbalance", partition.imbalance},
            {"partition_seconds", lasted.count()}};
  json.update(describe(loads));
  return json;
}

int number(const char* word) {
  const int value = std::atoi(word);
  if (value < 1) {
    throw std::invalid_argument(std::string("'") + word + "' is not a positive number");
  }
  return value;
}

}  // namespace
}  // namespace pounding::measuring

int main(int count, char** words) {
  using namespace pounding::measuring;
  try {
    if (count < 3) {
      throw std::invalid_argument("usage: partition_study CELLS_PER_METRE PARTS...");
    }
    const StoreyPair pair = build_storey_pair(number(words[1]));
    for (int i = 2; i < count; ++i) {
      std::printf("%s\n", study(pair, number(words[i])).dump().c_str());
      std::fflush(stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "partition_study: %s\n", error.what());
    return 1;
  }
}
