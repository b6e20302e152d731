#include "interactions/pairing/find_soil_rows.h"

#include <algorithm>

#include "common/error.h"

namespace pounding::interactions {
namespace {

[[noreturn]] void refuse_table(const Structure& structure, const std::string& why) {
  throw UserError("option -" + structure.name + "_soil_table " + structure.soil->table + ": " +
                  why);
}

/// Structures on the mats of the file of `first`, in the file's order.
std::vector<std::size_t> structures_on(const Structure& first, const Scene& scene) {
  const auto mats = static_cast<std::size_t>(first.soil->fitted->mats);
  const std::size_t none = scene.structures.size();
  std::vector<std::size_t> found(mats, none);
  for (std::size_t s = 0; s < none; ++s) {
    const Structure& structure = scene.structures[s];
    if (!structure.soil || structure.soil->table != first.soil->table) continue;
    std::size_t& place = found[static_cast<std::size_t>(structure.soil->table_mat - 1)];
    if (place != none) {
      refuse_table(structure, "its mat " + std::to_string(structure.soil->table_mat) +
                                  " is that of " + scene.structures[place].name + "; give -" +
                                  structure.name + "_soil_table_mat");
    }
    if (structure.soil->factor != first.soil->factor) {
      refuse_table(structure, "-" + structure.name + "_soil_factor differs from that of " +
                                  first.name + ", and both are on the same soil");
    }
    for (const Support& support : scene.supports) {
      if (std::ranges::none_of(support.groups, [&](const SupportedGroup& item) {
            return item.structure == structure.name && !item.is_all_ground();
          })) {
        continue;
      }
      refuse_table(structure,
                   "support " + support.name +
                       " moves a part of its ground, and soil between mats needs all of it "
                       "on one support; give -" +
                       support.name + "_groups " + structure.name);
    }
    place = s;
  }
  const auto free = std::ranges::find(found, none) - found.begin();
  if (free < static_cast<std::ptrdiff_t>(mats)) {
    refuse_table(first, "its mat " + std::to_string(free + 1) +
                            " is that of no structure; each of its mats belongs to one, by "
                            "-<structure>_soil_table and -<structure>_soil_table_mat");
  }
  return found;
}

/// Adds the motion of a mat's middle to a row, by the node that carries the soil.
void add_mat(int number, std::span<const double> motion, const Structure& structure,
             const GlobalMesh& mesh, SoilRow& row) {
  const auto region = std::ranges::find(structure.regions, ElementType::soil, &Region::element);
  const GlobalIndex node =
      std::ranges::find(mesh.regions, ElementType::soil, &ElementSet::type)->connectivity[0];
  Vector3 arm{};
  for (std::size_t d = 0; d < 3; ++d) {
    arm[d] = region->foundation->centre[d] - mesh.position(node)[d];
  }
  const std::array<double, 6> of_node = over_arm(motion, arm);
  for (int c = 0; c < 6; ++c) {
    const double value = of_node[static_cast<std::size_t>(c)];
    if (value != 0) row.terms.push_back({number, node, c, value});
  }
}

}  // namespace

std::vector<SoilRow> find_soil_rows(const Scene& scene, std::span<const GlobalMesh> meshes) {
  std::vector<SoilRow> rows;
  std::vector<std::string> seen;
  for (const Structure& first : scene.structures) {
    if (!first.soil || !first.soil->is_shared() ||
        std::ranges::find(seen, first.soil->table) != seen.end()) {
      continue;
    }
    seen.push_back(first.soil->table);
    if (!scene.export_matrices.empty()) {
      refuse_table(first,
                   "not with -export_matrices: no matrix of a structure holds soil between mats");
    }
    if (scene.certificate.window > 0) {
      refuse_table(
          first, "not with -fidelity_window: structures go on alone in it, and the soil is shared");
    }
    const std::vector<std::size_t> structures = structures_on(first, scene);
    for (const SoilPart& part : first.soil->fitted->shared) {
      SoilRow& row = rows.emplace_back(SoilRow{{}, part.impedance});
      for (std::size_t m = 0; m < structures.size(); ++m) {
        const std::size_t s = structures[m];
        add_mat(static_cast<int>(s), std::span(part.motion).subspan(6 * m, 6), scene.structures[s],
                meshes[s], row);
      }
    }
  }
  return rows;
}

}  // namespace pounding::interactions
