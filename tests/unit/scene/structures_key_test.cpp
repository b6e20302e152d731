#include "scene/structures_key.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "scene_cases.h"

namespace pounding {
namespace {

using scene_cases::pair;

std::string key_with(const std::string& name, const std::string& value) {
  OptionsDatabase database = pair();
  database[name] = value;
  return read_scene(database).scene.structures_key;
}

TEST(StructuresKey, KnowsTheStructuresAndNothingElse) {
  const std::string key = read_scene(pair()).scene.structures_key;
  EXPECT_EQ(key.size(), 16u);
  for (const auto& [name, value] : {std::pair{"floor2_gap", "0.05"},
                                    {"motion_x_pga", "3"},
                                    {"motion_x_seed", "8"},
                                    {"end_time", "1"},
                                    {"title", "other"},
                                    {"roof_at", "1,1,1"},
                                    {"courant", "0.99"},
                                    {"tower_mass_scaling", "1e-5"},
                                    {"tower_damping_alpha", "0.15620"},
                                    {"material_steel_young", "2e11"}}) {
    EXPECT_EQ(key_with(name, value), key) << name;
  }
  for (const auto& [name, value] : {std::pair{"tower_mesh", "other.geo"},
                                    {"tower_mesh_set", "h=0.24,slab=hex"},
                                    {"tower_clamp", "base"},
                                    {"tower_damping_alpha", "0.16"},
                                    {"tower_brace_area", "1.2e-4"},
                                    {"annex_slab_element", "hex8"},
                                    {"material_steel_young", "21e10"},
                                    {"section_heb120_area", "35e-4"},
                                    {"floor1_primary", "annex:face2"},
                                    {"floor1_passes", "2"}}) {
    EXPECT_NE(key_with(name, value), key) << name;
  }
  for (const auto& [name, silent, other] : {std::array{"tower_allow_loose", "false", "true"},
                                            {"floor1_friction", "0", "0.3"},
                                            {"floor1_passes", "1", "2"},
                                            {"tower_brace_yield_force", "0", "1e5"},
                                            {"tower_brace_tension_only", "false", "true"}}) {
    EXPECT_EQ(key_with(name, silent), key) << name;
    EXPECT_NE(key_with(name, other), key) << name;
  }
  OptionsDatabase reduced = pair();
  reduced["tower_model"] = "modal";
  reduced["tower_modal_vectors"] = "40";
  EXPECT_EQ(read_scene(reduced).scene.structures_key, key);
}

TEST(StructuresKey, MeshCountsByWhatItHolds) {
  const std::string one = testing::TempDir() + "structures_key_1.geo";
  const std::string two = testing::TempDir() + "structures_key_2.geo";
  const auto write = [](const std::string& path, const std::string& text) {
    std::ofstream(path) << text;
  };
  write(one, "Point(1) = {0, 0, 0};");
  write(two, "Point(1) = {0, 0, 0};");
  EXPECT_EQ(key_with("tower_mesh", one), key_with("tower_mesh", two));
  write(two, "Point(1) = {0, 0, 1};");
  EXPECT_NE(key_with("tower_mesh", one), key_with("tower_mesh", two));
  std::remove(one.c_str());
  std::remove(two.c_str());
}

}  // namespace
}  // namespace pounding
