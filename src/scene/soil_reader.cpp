#include "scene/soil_reader.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// A disk has one diameter, a rectangle two sides.
std::optional<std::array<double, 2>> read_sides(OptionReader& options, const Names& names,
                                                bool disk) {
  constexpr std::string_view pattern = "<structure>_soil_size";
  if (!options.given(pattern, names)) return std::nullopt;
  const std::vector<double> values = options.reals(pattern, names);
  options.refuse_if(values.size() != (disk ? 1 : 2), pattern, names,
                    disk ? "a disk has one diameter" : "a rectangle has two sides, along x and y");
  return std::array{values.front(), values.back()};
}

}  // namespace

std::optional<Soil> read_soil(OptionReader& options, const Structure& structure) {
  const Names names{structure.name};
  constexpr std::string_view mat = "<structure>_soil_mat";
  if (!options.given(mat, names) || options.text(mat, names) == "none") {
    options.forbid_all<Soil>(names, goes_with(mat), mat);
    return std::nullopt;
  }
  options.refuse_if(
      !structure.matrices.empty(), mat, names,
      "not with -<structure>_matrices; write its springs into the matrices and leave it out");
  Soil soil;
  options.read(soil, names);
  soil.ground.shear_velocity *= std::sqrt(soil.factor);
  if (!soil.is_half_space()) {
    options.forbid("<structure>_soil_size", names, std::string(Soil::no_half_space));
    return soil;
  }
  soil.sides = read_sides(options, names, soil.disk);
  options.refuse_if(
      soil.disk && soil.embedment > 0, "<structure>_soil_embedment", names,
      "only rectangles have factors of embedment; give 0, or a rectangle of the same area");
  return soil;
}

Region soil_region(const Soil& soil) {
  Region region;
  region.group = "soil under " + soil.mat;
  region.element = ElementType::soil;
  region.foundation.emplace();
  return region;
}

void lay_foundation(const MatOutline& outline, Structure& structure) {
  const auto region = std::ranges::find(structure.regions, ElementType::soil, &Region::element);
  region->foundation = foundation_of(*structure.soil, outline);
  region->stiffness = {};
  region->dashpot = {};
  for (const DirectedImpedance& part : region->foundation->impedances) {
    for (std::size_t c = 0; c < part.motion.size(); ++c) {
      region->stiffness[c] += part.motion[c] * part.impedance.stiffness * part.motion[c];
      region->dashpot[c] += part.motion[c] * part.impedance.dashpot * part.motion[c];
    }
  }
}

}  // namespace pounding
