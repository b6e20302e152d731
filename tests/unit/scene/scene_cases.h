#pragma once

#include <functional>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"
#include "scene/scene_reader.h"

/// Option databases that are scenes, and what the tests of the scene share.
namespace pounding::scene_cases {

/// One clamped block of hexahedra, nothing else: every other option holds its default.
inline OptionsDatabase smallest() {
  return {{"structures", "tower"},
          {"end_time", "2"},
          {"tower_mesh", "tower.geo"},
          {"tower_slab_element", "hex8"},
          {"tower_slab_material", "concrete"},
          {"material_concrete_young", "30e9"},
          {"material_concrete_poisson", "0.2"},
          {"material_concrete_density", "2400"}};
}

/// Two structures with beams and bars, an asymmetric gap, motion in two directions, two probes.
inline OptionsDatabase pair() {
  OptionsDatabase database = smallest();
  database["structures"] = "tower,annex";
  database.merge(OptionsDatabase{{"title", "Pair: \"2 cm\", 0.15 g"},
                                 {"tower_mesh_set", "h=0.12,slab=hex"},
                                 {"tower_clamp", "base, core:y+rx"},
                                 {"tower_damping_alpha", "0.1562"},
                                 {"tower_damping_beta", "1.2557e-5"},
                                 {"tower_column_element", "beam"},
                                 {"tower_column_material", "steel"},
                                 {"tower_column_section", "heb120"},
                                 {"tower_brace_element", "bar"},
                                 {"tower_brace_material", "steel"},
                                 {"tower_brace_area", "1.17e-4"},
                                 {"annex_mesh", "annex.msh"},
                                 {"annex_clamp", "base"},
                                 {"annex_damping_ratio", "0.006"},
                                 {"annex_damping_frequencies", "2.1,150"},
                                 {"annex_slab_element", "hex8_full"},
                                 {"annex_slab_material", "concrete"},
                                 {"material_steel_young", "200e9"},
                                 {"material_steel_poisson", "0.3"},
                                 {"material_steel_density", "7800"},
                                 {"section_heb120_area", "34.01e-4"},
                                 {"section_heb120_inertia_y", "317.5e-8"},
                                 {"section_heb120_inertia_z", "864.4e-8"},
                                 {"section_heb120_torsion", "13.84e-8"},
                                 {"section_heb120_z_axis", "1,0,0"},
                                 {"contacts", "floor1,floor2"},
                                 {"floor1_secondary", "tower:face1"},
                                 {"floor1_primary", "annex:face1"},
                                 {"floor2_secondary", "tower:face2"},
                                 {"floor2_primary", "annex:face2"},
                                 {"floor2_gap", "0.025, -0.001"},
                                 {"motion_x_target", "alluvial.csv"},
                                 {"motion_x_pga", "1.4715"},
                                 {"motion_x_seed", "7"},
                                 {"motion_z_record", "vertical.AT2"},
                                 {"motion_z_unit", "g"},
                                 {"motion_z_scale", "-0.5"},
                                 {"probes", "roof,foot"},
                                 {"roof_structure", "annex"},
                                 {"roof_at", "0.12,0.12,5.22; 3.24,0.12,5.22"},
                                 {"foot_structure", "tower"},
                                 {"foot_group", "base"},
                                 {"foot_average", "false"},
                                 {"courant", "0.8"},
                                 {"output", "results/pair"}});
  return database;
}

/// `database` with some options set anew.
inline OptionsDatabase with(OptionsDatabase database, const OptionsDatabase& changes) {
  for (const auto& [name, value] : changes) {
    database[name] = value;
  }
  return database;
}

inline OptionsDatabase without(OptionsDatabase database, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (database.erase(name) != 1) {
      throw std::logic_error(std::string("the case has no option ") + name);
    }
  }
  return database;
}

/// The error of reading, one line; fails the test when there is none.
inline std::string refusal(const OptionsDatabase& database) {
  try {
    read_scene(database);
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "the scene is not refused";
  return "";
}

/// The error holds every one of the words.
inline void expect_refused(const OptionsDatabase& database,
                           std::initializer_list<const char*> words) {
  const std::string message = refusal(database);
  for (const char* word : words) {
    EXPECT_THAT(message, testing::HasSubstr(word));
  }
}

/// Options from flat YAML, one `name: "value"` per line, as a YAML reader takes them.
inline OptionsDatabase read_flat_yaml(const std::string& text) {
  OptionsDatabase database;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') {
      continue;
    }
    const std::size_t colon = line.find(": \"");
    if (colon == std::string::npos || line.back() != '"') {
      throw std::logic_error("not a line of flat YAML: " + line);
    }
    std::string value;
    for (std::size_t i = colon + 3; i + 1 < line.size(); ++i) {
      if (line[i] == '\\') {
        ++i;
        value += line[i] == 'n' ? '\n' : line[i] == 't' ? '\t' : line[i];
      } else if (line[i] == '"') {
        throw std::logic_error("a bare quote: " + line);
      } else {
        value += line[i];
      }
    }
    if (!database.emplace(line.substr(0, colon), value).second) {
      throw std::logic_error("an option twice: " + line);
    }
  }
  return database;
}

}  // namespace pounding::scene_cases
