#include "driver/storeys.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <sstream>

#include "common/error.h"

namespace pounding {
namespace {

constexpr double same_height = 1e-6;  // m

/// Lowest z of a structure's nodes [m]. Collective.
double base_of(MPI_Comm comm, const Mesh& mesh) {
  double lowest = std::numeric_limits<double>::infinity();
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    lowest = std::min(lowest, mesh.position(node)[2]);
  }
  MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_DOUBLE, MPI_MIN, comm);
  return lowest;
}

bool is_floor(const Scene& scene, const std::string& probe) {
  return std::ranges::any_of(scene.probes,
                             [&](const Probe& each) { return each.floor && each.name == probe; });
}

}  // namespace

std::vector<Storey> find_storeys(MPI_Comm comm, const Scene& scene, const Model& model) {
  std::vector<Storey> storeys;
  for (std::size_t s = 0; s < model.meshes.size(); ++s) {
    std::vector<int> floors;
    for (std::size_t p = 0; p < model.probes.size(); ++p) {
      const bool here = model.probes[p].structure == static_cast<int>(s);
      if (here && is_floor(scene, model.probes[p].name)) floors.push_back(static_cast<int>(p));
    }
    const auto height = [&](int probe) {
      return model.probes[static_cast<std::size_t>(probe)].position[2];
    };
    std::ranges::stable_sort(floors, {}, height);
    const double base = base_of(comm, model.meshes[s]);
    for (std::size_t k = 0; k < floors.size(); ++k) {
      const int lower = k > 0 ? floors[k - 1] : -1;
      const double rise = height(floors[k]) - (lower < 0 ? base : height(lower));
      const auto name = [&](int probe) {
        return probe < 0 ? std::string("base") : model.probes[static_cast<std::size_t>(probe)].name;
      };
      if (rise > same_height) {
        storeys.push_back(
            {scene.structures[s].name, name(floors[k]), name(lower), floors[k], lower, rise});
      } else if (lower >= 0) {
        std::ostringstream text;
        text << "option -" << name(floors[k]) << "_floor: probe " << name(lower)
             << " is a floor at the same height, " << height(lower)
             << " m; mark one probe of each floor";
        throw UserError(text.str());
      }
    }
  }
  return storeys;
}

void print_drifts(const StoreyDrifts& drifts) {
  if (drifts.storeys().empty()) return;
  std::printf(
      "\nstorey                                 height m   drift x %%      at s   drift y %%      "
      "at s\n");
  for (std::size_t s = 0; s < drifts.storeys().size(); ++s) {
    const Storey& storey = drifts.storeys()[s];
    const auto& [x, y] = drifts.peaks()[s];
    std::printf("  %-36s %8.3f %11.4f %9.4f %11.4f %9.4f\n",
                (storey.upper + " over " + storey.lower).c_str(), storey.height, 100 * x.drift,
                x.time, 100 * y.drift, y.time);
  }
}

}  // namespace pounding
