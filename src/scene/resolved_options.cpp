#include "scene/resolved_options.h"

#include <algorithm>
#include <cctype>

#include "common/types.h"
#include "scene/option_table.h"

namespace pounding {
namespace {

/// A double-quoted YAML scalar.
std::string quoted(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n' || c == '\t') {
      text += c == '\n' ? "\\n" : "\\t";
    } else if (byte < ' ' || byte == 0x7f) {
      constexpr const char* digits = "0123456789abcdef";
      text += std::string("\\x") + digits[byte >> 4U] + digits[byte & 0xfU];
    } else {
      text += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
  }
  return text + "\"";
}

std::string yaml_line(const std::string& name, const std::string& value) {
  const bool plain =
      std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  return (plain ? name : quoted(name)) + ": " + quoted(value) + "\n";
}

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

OptionValues resolved_values(const OptionReader& options) {
  OptionValues values = options.in_force();
  for (const auto& [name, value] : options.database()) {
    if (is_petsc_option(name)) values.emplace_back(name, value);
  }
  return values;
}

std::string resolved_yaml(const OptionValues& resolved) {
  std::string text =
      "# All options in force, defaults included; running this file repeats the run.\n";
  for (const auto& [name, value] : resolved) text += yaml_line(name, value);
  return text;
}

OptionValues mesh_options(const OptionValues& in_force, const Scene& scene) {
  OptionValues options;
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
