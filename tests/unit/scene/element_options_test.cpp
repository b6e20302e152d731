#include "scene/option_blocks.h"
#include "scene_cases.h"

/// What each kind of element asks of its group.
namespace pounding::scene_cases {
namespace element_options_test {

using testing::ElementsAre;

OptionsDatabase with_group(const OptionsDatabase& group) {
  return with(smallest(), group);
}

/// The region `extra`, which comes first in the alphabet.
Region region(const OptionsDatabase& group) {
  return read_scene(with_group(group)).scene.structures[0].regions[0];
}

TEST(ElementOptions, Shell) {
  const Region shell = region({{"tower_extra_element", "shell"},
                               {"tower_extra_material", "concrete"},
                               {"tower_extra_thickness", "0.22"}});
  EXPECT_EQ(shell.element, ElementType::shell4);
  EXPECT_EQ(shell.thickness, 0.22);
  EXPECT_EQ(shell.rotary_inertia_factor, 0);
  EXPECT_EQ(shell.drilling_factor, 1);
  EXPECT_EQ(shell.added_mass, 0);
  expect_refused(
      with_group({{"tower_extra_element", "shell"}, {"tower_extra_material", "concrete"}}),
      {"-tower_extra_thickness", "[m]", "> 0"});
}

TEST(ElementOptions, WhatElementsCarry) {
  const Region shell = region({{"tower_extra_element", "shell"},
                               {"tower_extra_material", "concrete"},
                               {"tower_extra_thickness", "0.22"},
                               {"tower_extra_mass_per_area", "350"}});
  EXPECT_EQ(shell.added_mass, 350);
  OptionsDatabase bar{{"tower_extra_element", "bar"},
                      {"tower_extra_material", "concrete"},
                      {"tower_extra_area", "1e-4"},
                      {"tower_extra_mass_per_length", "12"}};
  EXPECT_EQ(region(bar).added_mass, 12);
  bar["tower_extra_mass_per_area"] = "12";
  expect_refused(with_group(bar), {"-tower_extra_mass_per_area", "not for the element bar"});
}

/// "extra_mass_per" and "extra" both have options that end in "area".
TEST(ElementOptions, AGroupIsTheShortestNameThatHasAnElement) {
  OptionsDatabase groups{{"tower_extra_element", "shell"},
                         {"tower_extra_material", "concrete"},
                         {"tower_extra_thickness", "0.22"},
                         {"tower_extra_mass_per_area", "350"}};
  EXPECT_EQ(region_groups(groups, "tower"), (std::set<std::string>{"extra"}));
  groups.erase("tower_extra_element");
  EXPECT_EQ(region_groups(groups, "tower"), (std::set<std::string>{"extra"}));
  groups["tower_extra_mass_per_element"] = "bar";
  EXPECT_EQ(region_groups(groups, "tower"), (std::set<std::string>{"extra", "extra_mass_per"}));
}

TEST(ElementOptions, TensionOnlyBar) {
  OptionsDatabase bar{{"tower_extra_element", "bar"},
                      {"tower_extra_material", "concrete"},
                      {"tower_extra_area", "1e-4"}};
  EXPECT_EQ(region(bar).element, ElementType::bar);
  bar["tower_extra_tension_only"] = "true";
  EXPECT_EQ(region(bar).element, ElementType::tension_bar);
}

TEST(ElementOptions, PointMassHasRotationsOnlyWithRotaryInertia) {
  OptionsDatabase mass{{"tower_extra_element", "point_mass"}, {"tower_extra_mass", "150"}};
  EXPECT_EQ(region(mass).element, ElementType::point_mass);
  EXPECT_EQ(region(mass).mass, 150);
  mass["tower_extra_rotary_inertia"] = "0,0,3";
  EXPECT_EQ(region(mass).element, ElementType::point_mass6);
  EXPECT_THAT(region(mass).rotary_inertia, ElementsAre(0, 0, 3));
  mass["tower_extra_material"] = "concrete";
  expect_refused(with_group(mass), {"-tower_extra_material", "point_mass"});
}

TEST(ElementOptions, SpringHasRotationsOnlyWithRotaryStiffness) {
  OptionsDatabase spring{{"tower_extra_element", "spring"},
                         {"tower_extra_stiffness", "1e6,2e6,3e6"}};
  EXPECT_EQ(region(spring).element, ElementType::spring);
  EXPECT_THAT(region(spring).stiffness, ElementsAre(1e6, 2e6, 3e6, 0, 0, 0));
  spring["tower_extra_dashpot"] = "0,0,0,0,5,0";
  EXPECT_EQ(region(spring).element, ElementType::spring6);
  spring["tower_extra_element"] = "grounded_spring";
  EXPECT_EQ(region(spring).element, ElementType::grounded_spring6);
  spring["tower_extra_stiffness"] = "1,2";
  expect_refused(with_group(spring), {"-tower_extra_stiffness 1,2", "wrong count"});
}

TEST(ElementOptions, BeamNeedsItsSectionAndOthersRefuseIt) {
  expect_refused(without(pair(), {"tower_column_section"}),
                 {"missing option -tower_column_section"});
  expect_refused(with(pair(), {{"tower_slab_section", "heb120"}}),
                 {"-tower_slab_section heb120", "hex8"});
}

TEST(ElementOptions, ShearAreasOfASection) {
  const auto column = [](const OptionsDatabase& more) {
    const Structure tower = read_scene(with(pair(), more)).scene.structures[0];
    return *std::ranges::find(tower.regions, "column", &Region::group);
  };
  const OptionsDatabase given{{"section_heb120_shear_area", "26e-4, 9e-4"}};
  EXPECT_EQ(column(given).section->shear_area_y, 26e-4);
  EXPECT_EQ(column(given).section->shear_area_z, 9e-4);
  EXPECT_TRUE(is_flexible_in_shear(column(given)));
  // A standard section has them, whatever else of it is given.
  EXPECT_NEAR(column({}).section->shear_area_z, 0.0007, 0.0002);
  EXPECT_EQ(column({}).section->area, 34.01e-4);
  OptionsDatabase euler = given;
  euler["tower_column_element"] = "euler_beam";
  EXPECT_EQ(column(euler).element, ElementType::euler_beam);
  EXPECT_FALSE(is_flexible_in_shear(column(euler)));
  for (const char* wrong : {"1e-3", "1e-3,0", "1e-3,-1", "1,2,3", "none", "nan,1", "1e-3,big"}) {
    expect_refused(with(pair(), {{"section_heb120_shear_area", wrong}}),
                   {"-section_heb120_shear_area", "two numbers y,z", "[m2]"});
  }
}

TEST(ElementOptions, BeamsMayBeDivided) {
  const auto parts = [](const std::string& word) {
    const Structure tower =
        read_scene(with(pair(), {{"tower_column_divide", word}})).scene.structures[0];
    return std::ranges::find(tower.regions, "column", &Region::group)->parts;
  };
  EXPECT_EQ(parts("none"), 1);
  EXPECT_EQ(parts("auto"), 0);
  EXPECT_EQ(parts("7"), 7);
  for (const char* wrong : {"0", "1", "-2", "2.5", "1001", "always", "nan"}) {
    expect_refused(with(pair(), {{"tower_column_divide", wrong}}),
                   {"-tower_column_divide", "auto", "from 2 to 1000"});
  }
  expect_refused(with(pair(), {{"tower_brace_divide", "auto"}}), {"-tower_brace_divide", "bar"});
}

TEST(ElementOptions, BarNeedsItsAreaAndOthersRefuseIt) {
  expect_refused(without(pair(), {"tower_brace_area"}),
                 {"missing option -tower_brace_area", "> 0", "[m2]"});
  expect_refused(with(pair(), {{"tower_column_area", "1e-4"}}),
                 {"-tower_column_area 1e-4", "beam"});
}

TEST(ElementOptions, GroupMayHaveDampingOfItsOwn) {
  const auto slab = [](const OptionsDatabase& damping) {
    const Structure tower = read_scene(with(pair(), damping)).scene.structures[0];
    EXPECT_EQ(tower.regions[2].group, "slab");
    return std::pair{tower, tower.regions[2]};
  };
  const auto [tower, without_its_own] = slab({});
  EXPECT_FALSE(without_its_own.damping);
  EXPECT_EQ(tower.damping_of(without_its_own).beta, 1.2557e-5);
  const auto [both_tower, both] =
      slab({{"tower_slab_damping_alpha", "0"}, {"tower_slab_damping_beta", "3e-5"}});
  EXPECT_EQ(both_tower.damping_of(both).alpha, 0);
  EXPECT_EQ(both_tower.damping_of(both).beta, 3e-5);
  EXPECT_EQ(both_tower.damping.beta, 1.2557e-5);
  EXPECT_FALSE(both_tower.regions[1].damping);
  // What is not given is the structure's.
  const auto [beta_tower, beta] = slab({{"tower_slab_damping_beta", "3e-5"}});
  EXPECT_EQ(beta_tower.damping_of(beta).alpha, 0.1562);
  EXPECT_EQ(beta_tower.damping_of(beta).beta, 3e-5);
  const auto [alpha_tower, alpha] = slab({{"tower_slab_damping_alpha", "2"}});
  EXPECT_EQ(alpha_tower.damping_of(alpha).alpha, 2);
  EXPECT_EQ(alpha_tower.damping_of(alpha).beta, 1.2557e-5);
}

TEST(ElementOptions, DampingRatioOfAGroupIsThatOfAStructure) {
  const Structure annex = read_scene(with(pair(), {{"annex_slab_damping_ratio", "0.006"},
                                                   {"annex_slab_damping_frequencies", "2.1,150"}}))
                              .scene.structures[1];
  ASSERT_TRUE(annex.regions[0].damping);
  EXPECT_EQ(annex.regions[0].damping->alpha, annex.damping.alpha);
  EXPECT_EQ(annex.regions[0].damping->beta, annex.damping.beta);
}

TEST(ElementOptions, DampingOfAGroupHasOneForm) {
  const OptionsDatabase ratio = with(
      pair(), {{"tower_slab_damping_ratio", "0.05"}, {"tower_slab_damping_frequencies", "1,9"}});
  expect_refused(with(ratio, {{"tower_slab_damping_beta", "1e-5"}}),
                 {"-tower_slab_damping_beta 1e-5", "either alpha and beta"});
  expect_refused(without(ratio, {"tower_slab_damping_frequencies"}),
                 {"missing option -tower_slab_damping_frequencies"});
  expect_refused(without(ratio, {"tower_slab_damping_ratio"}),
                 {"-tower_slab_damping_frequencies 1,9", "-tower_slab_damping_ratio"});
}

TEST(ElementOptions, BarsThatBuckleTakeTheDampingOfTheirStructure) {
  const OptionsDatabase bar = with(pair(), {{"tower_brace_damping_beta", "1e-5"}});
  EXPECT_TRUE(read_scene(bar).scene.structures[0].regions[0].damping);
  expect_refused(with(bar, {{"tower_brace_tension_only", "true"}}),
                 {"-tower_brace_damping_beta 1e-5", "tension_only"});
}

TEST(ElementOptions, GroupNeedsAnElement) {
  expect_refused(without(pair(), {"tower_brace_element"}),
                 {"missing option -tower_brace_element", "hex8", "bar"});
  expect_refused(with(pair(), {{"tower_slob_material", "concrete"}}),
                 {"missing option -tower_slob_element", "did you mean slab?"});
  expect_refused(with(pair(), {{"tower_slob_damping_beta", "1e-5"}}),
                 {"missing option -tower_slob_element", "did you mean slab?"});
}

TEST(ElementOptions, StructureNeedsAGroup) {
  expect_refused({{"structures", "tower"}, {"end_time", "1"}, {"tower_mesh", "a.msh"}},
                 {"tower has no elements", "-tower_GROUP_element"});
}

TEST(ElementOptions, ElementIsOneOfThoseThatExist) {
  expect_refused(with(pair(), {{"tower_slab_element", "hex20"}}),
                 {"-tower_slab_element hex20", "hex8_full", "beam"});
}

TEST(ElementOptions, WallNeedsADistance) {
  const OptionsDatabase wall = with(without(pair(), {"floor2_gap"}), {{"floor2_primary", "wall"}});
  expect_refused(wall, {"-floor2_gap geometry (default)", "wall"});
  const Scene scene = read_scene(with(wall, {{"floor2_gap", "0.03"}})).scene;
  EXPECT_TRUE(scene.contacts[1].primary.is_wall());
  expect_refused(with(wall, {{"floor2_gap", "0.03"}, {"floor2_passes", "2"}}),
                 {"-floor2_passes 2", "wall"});
}

}  // namespace element_options_test
}  // namespace pounding::scene_cases
