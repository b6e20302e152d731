// What METIS makes of the pair of buildings of storey_pair.h for any number of parts, none of which
// is run: loads, halos, neighbours, rows of contact. Serial.
//
//   partition_study CELLS_PER_METRE PARTS...
//
// Prints a line of JSON per number of parts.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmark/storey_pair.h"
#include "support/partition_loads.h"

namespace pounding::measuring {
namespace {

using Json = nlohmann::ordered_json;
using testing_support::part_loads;
using testing_support::PartLoad;

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

/// What a part has of the interface: rows with a node in it, and its own dofs in those of them that
/// have one elsewhere as well, which it sends to so many parts.
struct ContactLoad {
  long rows = 0;
  long sent = 0;
  std::set<int> partners;
};

/// Of all parts, every row on its own.
std::vector<ContactLoad> contact_loads(const interactions::Interface& interface,
                                       const Partition& partition, int parts) {
  std::vector<ContactLoad> loads(static_cast<std::size_t>(parts));
  for (const interactions::Constraint& constraint : interface.constraints) {
    std::map<int, long> dofs;  // per owner
    for (const interactions::ConstraintTerm& term : constraint.terms) {
      ++dofs[partition.node_owner[static_cast<std::size_t>(term.structure)]
                                 [static_cast<std::size_t>(term.node)]];
    }
    for (const auto& [owner, count] : dofs) {
      ContactLoad& load = loads[static_cast<std::size_t>(owner)];
      ++load.rows;
      if (dofs.size() == 1) continue;
      load.sent += count;
      for (const auto& other : dofs) {
        if (other.first != owner) load.partners.insert(other.first);
      }
    }
  }
  return loads;
}

Json describe(const std::vector<PartLoad>& loads, const std::vector<ContactLoad>& contact) {
  Json json;
  json["dofs_per_part"] = spread(loads, [](const PartLoad& load) { return load.dofs; });
  json["elements_per_part"] = spread(loads, [](const PartLoad& load) { return load.elements; });
  json["received"] = spread(loads, [](const PartLoad& load) { return load.received; });
  json["sent"] = spread(loads, [](const PartLoad& load) { return load.sent; });
  json["neighbours"] = spread(loads, [](const PartLoad& load) { return load.neighbours; });
  json["messages"] = spread(loads, [](const PartLoad& load) { return load.messages; });
  const auto largest = [&](const auto& of) { return std::ranges::max(contact, {}, of); };
  json["contact_rows_per_part"] = largest(&ContactLoad::rows).rows;
  json["contact_dofs_sent"] = largest(&ContactLoad::sent).sent;
  const auto partners = [](const ContactLoad& load) { return load.partners.size(); };
  json["contact_partners"] = partners(largest(partners));
  json["contact_members"] =
      std::ranges::count_if(contact, [](const ContactLoad& load) { return load.rows > 0; });
  return json;
}

Json study(const StoreyPair& pair, int parts) {
  const auto start = std::chrono::steady_clock::now();
  const Partition partition =
      partition_meshes(pair.meshes, interactions::facing_nodes(pair.interface), parts);
  const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - start;
  const std::vector<PartLoad> loads = part_loads(pair.meshes, partition);
  long dofs = 0;
  std::size_t elements = 0;
  for (const GlobalMesh& mesh : pair.meshes) elements += mesh.regions[0].tags.size();
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
  json.update(describe(loads, contact_loads(pair.interface, partition, parts)));
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
