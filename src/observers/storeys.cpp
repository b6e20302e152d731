#include "observers/storeys.h"

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "scene/support_reader.h"

namespace pounding {
namespace {

constexpr double same_height = 1e-6;  // m

/// Lowest z of a structure's nodes [m]. Collective.
double base_of(MPI_Comm comm, const Mesh& mesh) {
  double lowest = std::numeric_limits<double>::infinity();
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    lowest = std::min(lowest, mesh.position(node)[2]);
  }
  reduce_over_ranks(comm, MPI_MIN, lowest);
  return lowest;
}

bool is_floor(const Scene& scene, const std::string& probe) {
  return std::ranges::any_of(scene.probes,
                             [&](const Probe& each) { return each.floor && each.name == probe; });
}

/// Places among the probes of the floors of a structure, from below.
std::vector<int> floors_of(const Scene& scene, const Model& model, std::size_t structure) {
  std::vector<int> floors;
  for (std::size_t p = 0; p < model.probes.size(); ++p) {
    const bool here = model.probes[p].structure == static_cast<int>(structure);
    if (here && is_floor(scene, model.probes[p].name)) floors.push_back(static_cast<int>(p));
  }
  std::ranges::stable_sort(floors, {}, [&](int probe) {
    return model.probes[static_cast<std::size_t>(probe)].position[2];
  });
  return floors;
}

/// Numbers in the file order of the nodes up to a height, on all ranks; none where they follow the
/// ground along x and y. Collective.
std::vector<GlobalIndex> moving_nodes(MPI_Comm comm, const Mesh& mesh, double height,
                                      bool on_moving_support) {
  std::vector<GlobalIndex> own;
  bool moves = on_moving_support;
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    if (mesh.position(node)[2] > height) continue;
    own.push_back(mesh.file_node[node]);
    moves = moves || mesh.dof(node, 0) >= 0 || mesh.dof(node, 1) >= 0;
  }
  if (!on_any_rank(comm, moves)) return {};
  std::vector<GlobalIndex> nodes = gather_rows(comm, own);
  std::ranges::sort(nodes);
  return nodes;
}

}  // namespace

std::vector<ResolvedProbe> find_storey_bases(MPI_Comm comm, const Scene& scene,
                                             const Model& model) {
  constexpr double level = 1e-3;  // of the lowest storey
  std::vector<ResolvedProbe> bases;
  for (std::size_t s = 0; s < model.meshes.size(); ++s) {
    const std::vector<int> floors = floors_of(scene, model, s);
    if (floors.empty()) continue;
    const double lowest = base_of(comm, model.meshes[s]);
    const double rise = model.probes[static_cast<std::size_t>(floors.front())].position[2] - lowest;
    if (!(rise > same_height)) continue;
    ResolvedProbe base;
    base.name = scene.structures[s].name;
    base.structure = static_cast<int>(s);
    base.nodes = moving_nodes(comm, model.meshes[s], lowest + level * rise,
                              stands_on_moving_support(scene, scene.structures[s]));
    if (!base.nodes.empty()) bases.push_back(std::move(base));
  }
  return bases;
}

std::vector<Storey> find_storeys(MPI_Comm comm, const Scene& scene, const Model& model) {
  std::vector<Storey> storeys;
  for (std::size_t s = 0; s < model.meshes.size(); ++s) {
    const std::vector<int> floors = floors_of(scene, model, s);
    const auto height = [&](int probe) {
      return model.probes[static_cast<std::size_t>(probe)].position[2];
    };
    const double base = base_of(comm, model.meshes[s]);
    const auto moving =
        std::ranges::find(model.storey_bases, static_cast<int>(s), &ResolvedProbe::structure);
    const int moves = moving == model.storey_bases.end()
                          ? -1
                          : static_cast<int>(moving - model.storey_bases.begin());
    for (std::size_t k = 0; k < floors.size(); ++k) {
      const int lower = k > 0 ? floors[k - 1] : -1;
      const double rise = height(floors[k]) - (lower < 0 ? base : height(lower));
      const auto name = [&](int probe) {
        return probe < 0 ? std::string("base") : model.probes[static_cast<std::size_t>(probe)].name;
      };
      if (rise > same_height) {
        storeys.push_back({scene.structures[s].name, name(floors[k]), name(lower), floors[k], lower,
                           lower < 0 ? moves : -1, rise});
      } else if (lower >= 0) {
        throw UserError(
            sentence("option -{}_floor: probe {} is a floor at the same height, {} m; mark one "
                     "probe of each floor",
                     {name(floors[k]), name(lower), height(lower)}));
      }
    }
  }
  return storeys;
}

}  // namespace pounding
