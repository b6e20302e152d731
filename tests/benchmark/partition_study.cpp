// What METIS makes of the pair of buildings of storey_pair.h for any number of parts, none of which
// is run: loads, halos, neighbours, rows of contact. Serial.
//
//   partition_study CELLS_PER_METRE[xK] PARTS[/CORES]...
//
// xK: METIS parts these bricks, then each is divided into K^3 (refined_loads.h). CORES: parts on a
// node of a cluster. Prints a line of JSON per number of parts, with all loads of all parts.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmark/storey_pair.h"
#include "support/partition_loads.h"
#include "support/refined_loads.h"

namespace pounding::measuring {
namespace {

using Json = nlohmann::ordered_json;
using testing_support::part_loads;
using testing_support::PartLoad;
using testing_support::RefinedMesh;

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

struct ContactLoads {
  std::vector<ContactLoad> parts;
  long rows = 0;  ///< of the interface
};

/// Adds so many rows alike; `dofs`: of one of them, per owner.
void add_rows(const std::map<int, long>& dofs, long rows, ContactLoads& loads) {
  loads.rows += rows;
  for (const auto& [owner, count] : dofs) {
    ContactLoad& load = loads.parts[static_cast<std::size_t>(owner)];
    load.rows += rows;
    if (dofs.size() == 1) continue;
    load.sent += rows * count;
    for (const auto& other : dofs) {
      if (other.first != owner) load.partners.insert(other.first);
    }
  }
}

/// Of all parts, every row on its own.
ContactLoads contact_loads(const interactions::Interface& interface, const Partition& partition) {
  ContactLoads loads{std::vector<ContactLoad>(static_cast<std::size_t>(partition.parts))};
  for (const interactions::Constraint& constraint : interface.constraints) {
    std::map<int, long> dofs;
    for (const interactions::ConstraintTerm& term : constraint.terms) {
      ++dofs[partition.node_owner[static_cast<std::size_t>(term.structure)]
                                 [static_cast<std::size_t>(term.node)]];
    }
    add_rows(dofs, 1, loads);
  }
  return loads;
}

/// The same of divided meshes, whose nodes face each other in planes across x.
ContactLoads contact_loads(const interactions::Interface& interface,
                           const std::vector<RefinedMesh>& meshes, int parts) {
  ContactLoads loads{std::vector<ContactLoad>(static_cast<std::size_t>(parts))};
  std::set<std::array<int, 2>> facing;
  std::map<std::size_t, int> plane;  // of each structure
  for (const interactions::Constraint& constraint : interface.constraints) {
    for (const interactions::ConstraintTerm& term : constraint.terms) {
      const auto structure = static_cast<std::size_t>(term.structure);
      const auto& [x, y, z] = meshes[structure].place_of(term.node);
      plane[structure] = x;
      facing.insert({y, z});
    }
  }
  for (const auto& [y, z] : facing) {
    for (const auto& [dy, dz] : {std::array{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
      const bool faces = facing.contains({y + 2 * dy, z}) && facing.contains({y, z + 2 * dz}) &&
                         facing.contains({y + 2 * dy, z + 2 * dz});
      if (!faces) continue;
      std::map<int, long> dofs;
      for (const auto& [structure, x] : plane) {
        ++dofs[meshes[structure].owner({x, y + dy, z + dz})];
      }
      add_rows(dofs, meshes.front().nodes({0, y + dy, z + dz}), loads);
    }
  }
  return loads;
}

/// How a pair is parted.
struct Request {
  int cells_per_metre = 0;
  int divided = 1;  ///< every brick, along an edge
  int parts = 0;
  int cores = 0;  ///< of a node
};

Json describe(const std::vector<PartLoad>& loads, const std::vector<ContactLoad>& contact) {
  Json json;
  json["dofs_per_part"] = spread(loads, [](const PartLoad& load) { return load.dofs; });
  json["elements_per_part"] = spread(loads, [](const PartLoad& load) { return load.elements; });
  json["outer_per_part"] =
      spread(loads, [](const PartLoad& load) { return load.elements - load.inner; });
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

/// A list of every load, over the parts.
Json list_parts(const std::vector<PartLoad>& loads, const ContactLoads& contact) {
  Json json;
  for (std::size_t p = 0; p < loads.size(); ++p) {
    json["elements"].push_back(loads[p].elements);
    json["inner"].push_back(loads[p].inner);
    json["sent"].push_back(loads[p].sent);
    json["received"].push_back(loads[p].received);
    json["messages"].push_back(loads[p].messages);
    json["sent_away"].push_back(loads[p].sent_away);
    json["messages_away"].push_back(loads[p].messages_away);
    json["rows"].push_back(contact.parts[p].rows);
    json["contact_sent"].push_back(contact.parts[p].sent);
    json["partners"].push_back(contact.parts[p].partners.size());
  }
  return json;
}

Json study(const StoreyPair& pair, const Request& request) {
  const auto start = std::chrono::steady_clock::now();
  const Partition partition =
      partition_meshes(pair.meshes, interactions::facing_nodes(pair.interface), request.parts);
  const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - start;
  std::vector<PartLoad> loads;
  ContactLoads contact;
  if (request.divided == 1) {
    loads = part_loads(pair.meshes, partition, request.cores);
    contact = contact_loads(pair.interface, partition);
  } else {
    const auto refined = testing_support::refined_meshes(pair.meshes, partition, request.divided);
    loads = testing_support::refined_loads(refined, request.parts, request.cores);
    contact = contact_loads(pair.interface, refined, request.parts);
  }
  long dofs = 0;
  long elements = 0;
  for (const GlobalMesh& mesh : pair.meshes) {
    elements += static_cast<long>(mesh.regions[0].tags.size());
  }
  elements *= static_cast<long>(request.divided) * request.divided * request.divided;
  for (const PartLoad& load : loads) dofs += load.dofs;
  Json json{{"parts", request.parts},
            {"cores", request.cores},
            {"cells_per_metre", request.cells_per_metre * request.divided},
            {"divided", request.divided},
            {"dofs", dofs},
            {"elements", elements},
            {"contact_rows", contact.rows},
            {"edge_cut", partition.edge_cut},
            {"cost_imbalance", partition.imbalance},
            {"partition_seconds", lasted.count()}};
  json.update(describe(loads, contact.parts));
  json["of_parts"] = list_parts(loads, contact);
  return json;
}

/// "A<mark>B", or "A" and the other one by default.
std::array<int, 2> numbers(const std::string& word, char mark, int other) {
  std::istringstream text(word);
  std::array<int, 2> read{0, other};
  char found = mark;
  text >> read[0];
  if (!text.eof()) text >> found >> read[1];
  if (!text || found != mark || !text.eof() || read[0] < 1 || read[1] < 1) {
    throw std::invalid_argument("'" + word + "' is not a positive number, or two with '" + mark +
                                "' between");
  }
  return read;
}

}  // namespace
}  // namespace pounding::measuring

int main(int count, char** words) {
  using namespace pounding::measuring;
  try {
    if (count < 3) {
      throw std::invalid_argument("usage: partition_study CELLS_PER_METRE[xK] PARTS[/CORES]...");
    }
    const auto [cells, divided] = numbers(words[1], 'x', 1);
    const StoreyPair pair = build_storey_pair(cells);
    for (int i = 2; i < count; ++i) {
      const auto [parts, cores] = numbers(words[i], '/', std::numeric_limits<int>::max());
      std::printf("%s\n", study(pair, {cells, divided, parts, cores}).dump().c_str());
      std::fflush(stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "partition_study: %s\n", error.what());
    return 1;
  }
}
