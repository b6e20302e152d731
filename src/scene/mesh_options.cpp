#include "scene/mesh_options.h"

#include <algorithm>

#include "common/component_names.h"
#include "scene/option_table.h"

namespace pounding {
namespace {

/// Whether an option is of the motion of the ground or of the spectra.
bool is_of_motion(const std::string& name) {
  return std::ranges::any_of(option_table(), [&](const OptionRow& row) {
    if (row.block == OptionBlock::spectra) return name == row.pattern;
    return row.block == OptionBlock::motion && match_option(row.pattern, name).has_value();
  });
}

/// Whether an option names a file of a structure whose name says nothing about the pieces.
bool is_file(const std::string& name, const Scene& scene) {
  return std::ranges::any_of(scene.structures, [&](const Structure& structure) {
    return name == structure.name + "_mesh" || name == structure.name + "_modal_basis";
  });
}

}  // namespace

std::vector<std::pair<std::string, std::string>> mesh_options(
    const std::vector<std::pair<std::string, std::string>>& in_force, const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const auto& [name, value] : in_force) {
    const bool counts =
        !may_differ(name, Comparison::pieces) && !is_of_motion(name) && !is_file(name, scene);
    if (counts) options.emplace_back(name, value);
  }
  for (const Structure& structure : scene.structures) {
    const bool follows = std::ranges::any_of(structure.regions, [](const Region& region) {
      return is_beam(region.element) && region.parts == 0;
    });
    if (follows) {
      options.emplace_back(
          "spectra_frequencies (the highest, for the beams of " + structure.name + ")",
          std::to_string(scene.spectra.frequencies.back()));
    }
  }
  for (std::size_t d = 0; d < scene.motion.size(); ++d) {
    if (scene.motion[d]) options.emplace_back("motion_" + std::string(motion_names[d]), "given");
  }
  return options;
}

}  // namespace pounding
