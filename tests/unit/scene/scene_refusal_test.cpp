#include "scene_cases.h"

/// Every mistake is one line: option, value seen, what is expected.
namespace pounding::scene_cases {
namespace scene_refusal_test {

TEST(SceneRefusal, MissingOptions) {
  expect_refused({}, {"missing option -structures"});
  expect_refused(without(smallest(), {"end_time"}), {"missing option -end_time", "> 0", "[s]"});
  expect_refused(without(smallest(), {"tower_mesh"}), {"missing option -tower_mesh", ".geo"});
  expect_refused(without(smallest(), {"tower_slab_material"}),
                 {"missing option -tower_slab_material"});
  expect_refused(without(smallest(), {"material_concrete_poisson"}),
                 {"missing option -material_concrete_poisson", "(-1, 0.5)"});
  expect_refused(without(pair(), {"section_heb120_z_axis"}),
                 {"missing option -section_heb120_z_axis"});
  expect_refused(without(pair(), {"floor2_primary"}),
                 {"missing option -floor2_primary", "structure:group"});
  expect_refused(without(pair(), {"roof_structure"}), {"missing option -roof_structure"});
}

struct BadValue {
  const char* option;
  const char* value;
  const char* expected;
};

void PrintTo(const BadValue& bad, std::ostream* out) {
  *out << '-' << bad.option << ' ' << bad.value;
}

class BadValues : public testing::TestWithParam<BadValue> {};

TEST_P(BadValues, AreRefusedWithWhatIsExpected) {
  const auto& [option, value, expected] = GetParam();
  const std::string start = std::string("option -") + option + " " + value;
  expect_refused(with(pair(), {{option, value}}), {start.c_str(), expected});
}

INSTANTIATE_TEST_SUITE_P(
    Numbers, BadValues,
    testing::Values(
        BadValue{"end_time", "nan", "a number > 0 [s]"},
        BadValue{"end_time", "inf", "a number > 0 [s]"}, BadValue{"end_time", "0", "> 0 [s]"},
        BadValue{"courant", "0", "a number in (0, 1] [-]"},
        BadValue{"courant", "1.01", "a number in (0, 1] [-]"},
        BadValue{"courant", "0,9", "a number in (0, 1] [-]"},
        BadValue{"time_step", "-1e-6", "a number >= 0 [s]"},
        BadValue{"modes", "3.5", "an integer >= 0 [-]"},
        BadValue{"modes", "-1", "an integer >= 0 [-]"}, BadValue{"gap_tolerance", "-1", ">= 0"},
        BadValue{"impact_merge_time", "-1", ">= 0 [s]"},
        BadValue{"output_interval", "0", "> 0 [s]"}, BadValue{"energy_interval", "0", ">= 1"},
        BadValue{"allow_unstable", "perhaps", "true or false"},
        BadValue{"tower_damping_alpha", "-0.1", ">= 0 [1/s]"},
        BadValue{"tower_damping_beta", "-1e-5", ">= 0 [s]"},
        BadValue{"annex_damping_ratio", "1", "[0, 1)"},
        BadValue{"annex_damping_frequencies", "2.1", "two numbers f1,f2"},
        BadValue{"annex_damping_frequencies", "0,150", "> 0 [Hz]"},
        BadValue{"tower_slab_damping_alpha", "-0.1", ">= 0 [1/s]"},
        BadValue{"tower_slab_damping_beta", "-1e-5", ">= 0 [s]"},
        BadValue{"tower_slab_damping_ratio", "-0.1", "[0, 1)"},
        BadValue{"tower_slab_damping_ratio", "1", "[0, 1)"},
        BadValue{"tower_gravity", "9.81", "three numbers"},
        BadValue{"tower_initial_displacement", "0.1", "three numbers"},
        BadValue{"tower_initial_displacement", "0,inf,0", "three numbers"},
        BadValue{"tower_brace_area", "0", "> 0 [m2]"},
        BadValue{"material_steel_young", "-200e9", "> 0 [Pa]"},
        BadValue{"material_steel_poisson", "0.5", "in (-1, 0.5) [-]"},
        BadValue{"material_steel_density", "-1", ">= 0 [kg/m3]"},
        BadValue{"material_concrete_density", "0", "group slab is of solids or shells"},
        BadValue{"section_heb120_torsion", "0", "> 0 [m4]"},
        BadValue{"section_heb120_z_axis", "0,0,0", "not all zero"},
        BadValue{"section_heb120_z_axis", "1,0", "three numbers"},
        BadValue{"motion_x_pga", "-1", ">= 0 [m/s2]"}, BadValue{"motion_x_pga", "0", "above 0"},
        BadValue{"motion_x_seed", "1.5", "an integer"},
        BadValue{"motion_x_envelope", "15,2", "t1 is above t2"},
        BadValue{"motion_x_envelope", "2,26", "-motion_x_duration"},
        BadValue{"motion_z_column", "-1", ">= 0"},
        BadValue{"motion_z_scale", "big", "a number [-]"},
        BadValue{"floor2_gap", "1,2,3", "one, two or four numbers"},
        BadValue{"floor2_gap", "nan", "one, two or four numbers"},
        BadValue{"spectra_damping", "0.05,1", "[0, 1)"},
        BadValue{"spectra_frequencies", "400:0.5:200log", "start:stop:COUNTlog"},
        BadValue{"spectra_frequencies", "0:400:200lin", "> 0"}));

INSTANTIATE_TEST_SUITE_P(
    Words, BadValues,
    testing::Values(BadValue{"resampling", "cubic", "one of: linear band_limited"},
                    BadValue{"tower_model", "reduced", "one of: full modal"},
                    BadValue{"tower_model", "modl", "did you mean modal?"},
                    BadValue{"tower_mesh_set", "h", "name=value"},
                    BadValue{"tower_mesh_set", "h=1,h=2", "h is set twice"},
                    BadValue{"tower_clamp", "base,,core", "empty name"},
                    BadValue{"tower_clamp", "base,base", "base appears twice"},
                    BadValue{"tower_clamp", "base,base:x", "'base' is listed twice"},
                    BadValue{"tower_clamp", "base:x+w", "'w' is no component of x, y, z"},
                    BadValue{"tower_clamp", "base:", "'' is no component"},
                    BadValue{"tower_clamp", "base:x:y", "is not group or group:components"},
                    BadValue{"tower_clamp", ":x", "is not group or group:components"},
                    BadValue{"tower_mesh", "", "(no value)"},
                    BadValue{"structures", "none", "at least one name"},
                    BadValue{"contacts", "", "or none"},
                    BadValue{"motion_z_unit", "ft/s2", "one of: auto g m/s2 cm/s2"},
                    BadValue{"floor1_primary", "annex", "structure:group"},
                    BadValue{"floor1_primary", "annnex:face1", "did you mean annex?"},
                    BadValue{"roof_structure", "anex", "did you mean annex?"},
                    BadValue{"roof_at", "1,2", "x,y,z; x,y,z"},
                    BadValue{"tower_slab_material", "concret", "did you mean concrete?"},
                    BadValue{"tower_column_section", "heb12", "did you mean heb120?"}));

TEST(SceneRefusal, DampingHasOneForm) {
  expect_refused(with(pair(), {{"annex_damping_alpha", "0.1"}}),
                 {"-annex_damping_alpha 0.1", "either alpha and beta, or ratio and frequencies"});
  expect_refused(without(pair(), {"annex_damping_frequencies"}),
                 {"missing option -annex_damping_frequencies"});
  expect_refused(without(pair(), {"annex_damping_ratio"}),
                 {"-annex_damping_frequencies", "-annex_damping_ratio"});
}

TEST(SceneRefusal, ProbeHasOnePlace) {
  expect_refused(with(pair(), {{"roof_group", "top"}}), {"probe roof", "only one", "-roof_at"});
  expect_refused(without(pair(), {"roof_at"}), {"probe roof", "-roof_at", "-roof_group"});
}

TEST(SceneRefusal, NamesAreLettersDigitsAndUnderscores) {
  for (const char* name : {"1st", "a-b", "a b", "_a", "tour\xc3\xa9"}) {
    expect_refused(with(smallest(), {{"probes", name}}), {"-probes", "is not a name"});
  }
}

TEST(SceneRefusal, NamesAreNotWordsOfTheOptions) {
  for (const char* name : {"material", "section", "motion", "spectra", "courant", "wall",
                           "motion_1", "lowest", "options", "lowest"}) {
    expect_refused(with(smallest(), {{"probes", name}}), {"-probes", name, "choose another name"});
  }
}

TEST(SceneRefusal, NamesAreUsedOnce) {
  expect_refused(with(smallest(), {{"structures", "tower,tower"}}), {"tower appears twice"});
  expect_refused(with(smallest(), {{"probes", "tower"}}), {"-probes", "'tower' names something"});
  expect_refused(with(smallest(), {{"probes", "Tower"}}), {"-probes", "'Tower' names something"});
}

TEST(SceneRefusal, StructuresWhoseOptionsCouldBeMixedUp) {
  expect_refused(with(smallest(), {{"structures", "tower,tower_annex"}}),
                 {"'tower_annex' begins with 'tower_'"});
}

TEST(SceneRefusal, MotionOptionsWithoutEffect) {
  expect_refused(with(pair(), {{"motion_y_pga", "1"}}),
                 {"-motion_y_pga 1", "no motion along y", "-motion_y_record"});
  expect_refused(with(pair(), {{"motion_x_column", "2"}}),
                 {"-motion_x_column 2", "-motion_x_record"});
  expect_refused(with(pair(), {{"motion_z_seed", "2"}}), {"-motion_z_seed 2", "-motion_z_target"});
  expect_refused(with(pair(), {{"motion_z_pga", "1"}}), {"-motion_z_scale -0.5", "-motion_z_pga"});
}

}  // namespace scene_refusal_test
}  // namespace pounding::scene_cases
