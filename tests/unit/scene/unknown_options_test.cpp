#include "scene/unknown_options.h"

#include "scene_cases.h"

namespace pounding::scene_cases {
namespace unknown_options_test {

TEST(UnknownOptions, AreRefusedWithTheNearestName) {
  EXPECT_EQ(refusal(with(pair(), {{"tower_dampng_beta", "1e-5"}})),
            "unknown option -tower_dampng_beta (value 1e-5); did you mean -tower_damping_beta?");
  EXPECT_EQ(refusal(with(pair(), {{"courrant", "0.9"}})),
            "unknown option -courrant (value 0.9); did you mean -courant?");
  EXPECT_EQ(refusal(with(pair(), {{"dryrun", ""}})),
            "unknown option -dryrun (value (no value)); did you mean -dry_run?");
  expect_refused(with(pair(), {{"motion_x_pgaa", "1"}}), {"did you mean -motion_x_pga?"});
  expect_refused(with(pair(), {{"spectra_dampings", "0"}}), {"did you mean -spectra_damping?"});
  expect_refused(with(pair(), {{"tower_slab_materiel", "x"}}), {"-tower_slab_material?"});
}

TEST(UnknownOptions, MisspeltRequiredOptionIsNamedBeforeTheMissingOne) {
  OptionsDatabase database = without(smallest(), {"tower_mesh"});
  database["tower_mseh"] = "tower.geo";
  expect_refused(database, {"unknown option -tower_mseh", "did you mean -tower_mesh?"});
  database = without(smallest(), {"material_concrete_young"});
  database["material_concrete_yuong"] = "30e9";
  expect_refused(database, {"-material_concrete_yuong", "did you mean -material_concrete_young?"});
}

TEST(UnknownOptions, NoSuggestionWhereNothingIsNear) {
  EXPECT_EQ(refusal(with(pair(), {{"colour", "red"}})),
            "unknown option -colour (value red); see pounding -help");
}

TEST(UnknownOptions, OptionsOfAStructureThatIsNotListed) {
  expect_refused(with(pair(), {{"tower2_mesh", "x.geo"}}), {"unknown option -tower2_mesh"});
}

TEST(UnknownOptions, LibrariesOfMaterialsAndSectionsMayStandUnused) {
  EXPECT_NO_THROW(read_scene(with(pair(), {{"material_wood_young", "1e10"},
                                           {"material_wood_poisson", "0.4"},
                                           {"material_wood_density", "500"},
                                           {"section_ipe_area", "1"},
                                           {"section_ipe_inertia_y", "1"},
                                           {"section_ipe_inertia_z", "1"},
                                           {"section_ipe_torsion", "1"},
                                           {"section_ipe_z_axis", "0,0,1"}})));
}

TEST(UnknownOptions, PiecesOfAnUnusedBlockAreMistakes) {
  expect_refused(with(pair(), {{"material_stel_young", "1e10"}}),
                 {"did you mean -material_steel_young?"});
  expect_refused(with(pair(), {{"section_heb12_area", "1"}}),
                 {"did you mean -section_heb120_area?"});
  expect_refused(with(pair(), {{"flor2_gap", "0.01"}}), {"did you mean -floor2_gap?"});
  expect_refused(with(pair(), {{"flor2_secondary", "tower:a"}}),
                 {"did you mean -floor2_secondary?"});
  expect_refused(with(pair(), {{"rof_structure", "annex"}}), {"did you mean -roof_structure?"});
}

TEST(UnknownOptions, OptionsOfTheLibrariesPass) {
  EXPECT_NO_THROW(read_scene(with(
      pair(),
      {{"log_view", ""}, {"lowest_st_mat_mumps_icntl_14", "50"}, {"lowest_eps_tol", "1e-9"}})));
  expect_refused(with(pair(), {{"log_view", ":elsewhere.txt"}}), {"-log_view :elsewhere.txt"});
  expect_refused(with(pair(), {{"info", "elsewhere"}}), {"-info"});
  expect_refused(with(pair(), {{"options_file", "case.yaml"}}), {"-options_file"});
}

}  // namespace unknown_options_test
}  // namespace pounding::scene_cases
