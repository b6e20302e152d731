#include "scene/option_table.h"

#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/option_values.h"
#include "scene/unknown_options.h"

namespace pounding {
namespace option_table_test {

TEST(OptionTable, PatternsAreUnique) {
  std::set<std::string_view> patterns;
  for (const OptionRow& row : option_table()) {
    EXPECT_TRUE(patterns.insert(row.pattern).second) << row.pattern;
  }
}

TEST(OptionTable, EveryDefaultIsAnAdmittedValue) {
  for (const OptionRow& row : option_table()) {
    if (!row.preset.has_value) {
      continue;
    }
    switch (row.kind) {
      case OptionKind::real:
        ASSERT_TRUE(parse_real(row.preset.text)) << row.pattern;
        EXPECT_TRUE(row.range.contains(*parse_real(row.preset.text))) << row.pattern;
        break;
      case OptionKind::integer:
        ASSERT_TRUE(parse_integer(row.preset.text)) << row.pattern;
        EXPECT_TRUE(row.range.contains(*parse_integer(row.preset.text))) << row.pattern;
        break;
      case OptionKind::boolean:
        EXPECT_TRUE(parse_boolean(row.preset.text)) << row.pattern;
        break;
      case OptionKind::choice:
        EXPECT_THAT(split(row.form, '|'), testing::Contains(row.preset.text)) << row.pattern;
        break;
      case OptionKind::reals:
        EXPECT_TRUE(parse_reals(row.preset.text)) << row.pattern;
        break;
      case OptionKind::text:
      case OptionKind::names:
        break;
    }
  }
}

/// The line of the help that belongs to a pattern.
std::string help_line(std::string_view pattern) {
  std::istringstream lines(help_text());
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  -" + std::string(pattern) + " ")) {
      return line;
    }
  }
  return "";
}

TEST(Help, ListsEveryPatternWithUnitDefaultRangeAndOneLine) {
  for (const OptionRow& row : option_table()) {
    const std::string line = help_line(row.pattern);
    ASSERT_FALSE(line.empty()) << row.pattern;
    EXPECT_FALSE(row.unit.empty()) << row.pattern;
    EXPECT_FALSE(row.help.empty()) << row.pattern;
    EXPECT_THAT(line, testing::HasSubstr("[" + std::string(row.unit) + "]"));
    EXPECT_THAT(line, testing::HasSubstr(std::string(row.help)));
    EXPECT_THAT(line, testing::HasSubstr(std::string(row.preset.text)));
    if (row.range.text() != "any") {
      EXPECT_THAT(line, testing::HasSubstr(row.range.text()));
    }
    if (row.preset.required) {
      EXPECT_THAT(line, testing::HasSubstr("; required"));
    }
  }
}

TEST(Help, ShowsUsageAndTheLibrariesOptions) {
  EXPECT_THAT(help_text(), testing::HasSubstr("mpirun -n 2 pounding -options_file case.yaml"));
  for (const std::string_view pattern : petsc_option_patterns()) {
    EXPECT_THAT(help_text(), testing::HasSubstr(" -" + std::string(pattern)));
  }
}

TEST(OptionTable, RangesReadLikeMathematics) {
  EXPECT_EQ(option_row("courant").range.text(), "(0, 1]");
  EXPECT_EQ(option_row("end_time").range.text(), "> 0");
  EXPECT_EQ(option_row("modes").range.text(), ">= 0");
  EXPECT_EQ(option_row("material_<material>_poisson").range.text(), "(-1, 0.5)");
  EXPECT_EQ(option_row("motion_<x|y|z>_scale").range.text(), "any");
  EXPECT_EQ(option_row("omega_max_tolerance").range.text(), "[1e-10, 0.1]");
}

TEST(OptionTable, RangesHoldTheirClosedEndsOnly) {
  const AdmittedRange range = option_row("courant").range;
  EXPECT_FALSE(range.contains(0));
  EXPECT_TRUE(range.contains(1e-300));
  EXPECT_TRUE(range.contains(1));
  EXPECT_FALSE(range.contains(1.0000001));
  EXPECT_TRUE(option_row("modes").range.contains(0));
}

TEST(OptionTable, PlaceholdersTakeNamesInOrder) {
  EXPECT_EQ(option_name("<structure>_<group>_element", {"s1", "slab"}), "s1_slab_element");
  EXPECT_EQ(option_name("motion_<x|y|z>_pga", {"y"}), "motion_y_pga");
  EXPECT_EQ(match_option("material_<material>_young", "material_steel_young"), "steel");
  EXPECT_FALSE(match_option("material_<material>_young", "material__young"));
  EXPECT_FALSE(match_option("material_<material>_young", "material_steel_density"));
  EXPECT_THROW(option_name("courant", {"s1"}), std::logic_error);
  EXPECT_THROW(option_name("<probe>_at", {}), std::logic_error);
  EXPECT_THROW(option_row("damping"), std::logic_error);
}

TEST(OptionTable, OptionsOfTheLibrariesAreKnown) {
  for (const char* name : {"log_view", "lowest_st_mat_mumps_icntl_14", "lowest_eps_tol",
                           "lowest_eps_type", "malloc_debug", "options_left"}) {
    EXPECT_TRUE(is_petsc_option(name)) << name;
  }
  for (const char* name :
       {"courant", "kspace", "end_time", "s1_mat_area", "includes", "info",
        "on_error_attach_debugger", "start_in_debugger", "options_file", "options_view",
        "viewer_binary_filename", "log_trace", "mat_view", "lowest_eps_view_vectors",
        "lowest_eps_monitor_all", "largest_eps_tol"}) {
    EXPECT_FALSE(is_petsc_option(name)) << name;
  }
}

TEST(OptionTable, ValuesOfTheLibrariesOptionsAreChecked) {
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"log_view", ""},
                                          {"malloc_view", "true"},
                                          {"lowest_eps_type", "arnoldi"},
                                          {"lowest_eps_ncv", "40"},
                                          {"lowest_st_mat_mumps_icntl_14", "-1"},
                                          {"lowest_eps_tol", "1e-9"},
                                          {"not_of_petsc", "whatever"}}) {
    EXPECT_EQ(petsc_value_fault(name, value), std::nullopt) << name;
  }
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"log_view", ":/tmp/log.txt"},
                                          {"malloc_view", "list.txt"},
                                          {"lowest_eps_view", "ascii:solver.txt"},
                                          {"lowest_eps_monitor", "draw"},
                                          {"lowest_eps_ncv", "0"},
                                          {"lowest_eps_max_it", "1e3"},
                                          {"lowest_st_mat_mumps_icntl_14", "much"},
                                          {"lowest_eps_tol", "-1e-9"}}) {
    EXPECT_NE(petsc_value_fault(name, value), std::nullopt) << name;
  }
  EXPECT_EQ(petsc_value_fault("lowest_eps_type", "krylovshur"),
            "expected one of: krylovschur arnoldi; did you mean krylovschur?");
}

TEST(OptionTable, ContinuedRunKeepsWhatTouchesTheMotion) {
  for (const char* name : {"end_time", "output", "restart", "checkpoint_steps", "log_view"}) {
    EXPECT_TRUE(may_differ(name, Comparison::restart)) << name;
  }
  for (const char* name : {"structures", "tower_mesh", "tower_damping_beta", "output_interval",
                           "energy_interval", "impact_merge_time", "motion_x_pga"}) {
    EXPECT_FALSE(may_differ(name, Comparison::restart)) << name;
  }
}

TEST(OptionTable, SaysInWhichComparisonsAnOptionIsFree) {
  const std::vector<Comparison> all{Comparison::pieces, Comparison::scene, Comparison::ensemble,
                                    Comparison::restart};
  const std::map<std::string, std::vector<Comparison>> free{
      {"vector_unit", all},
      {"write_modes", all},
      {"log_view", all},
      {"partition", {Comparison::scene, Comparison::ensemble, Comparison::restart}},
      {"fields_interval", {Comparison::pieces, Comparison::scene, Comparison::ensemble}},
      {"modes", {Comparison::pieces, Comparison::ensemble, Comparison::restart}},
      {"end_time", {Comparison::pieces, Comparison::restart}},
      {"spectra_damping", {Comparison::restart}},
      {"ensemble", {Comparison::ensemble}},
      {"gravity", {}},
      {"tower_mesh", {}}};
  for (const auto& [name, where] : free) {
    for (const Comparison one : all) {
      EXPECT_EQ(may_differ(name, one), std::ranges::find(where, one) != where.end())
          << name << " in comparison " << static_cast<int>(one);
    }
  }
}

}  // namespace option_table_test
}  // namespace pounding
