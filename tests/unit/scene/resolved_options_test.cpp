#include "scene/resolved_options.h"

#include <iomanip>

#include "scene/options_database.h"
#include "scene_cases.h"

/// The options in force, read back, give the same scene.
namespace pounding::scene_cases {
namespace resolved_options_test {

void describe(std::ostream& out, const Structure& structure) {
  out << structure.name << ' ' << structure.mesh << '\n';
  for (const auto& [name, value] : structure.mesh_set) {
    out << name << '=' << value << ' ';
  }
  for (const Clamp& clamp : structure.clamps) {
    out << clamp.group << ' ' << static_cast<int>(clamp.components) << ' ';
  }
  out << structure.damping.alpha << ' ' << structure.damping.beta << '\n';
  out << structure.initial_displacement[0] << ' ' << structure.initial_velocity[0] << '\n';
  for (const Region& region : structure.regions) {
    out << region.group << ' ' << static_cast<int>(region.element) << ' ' << region.material.name
        << ' ' << region.material.young << ' ' << region.material.poisson << ' '
        << region.material.density << ' ' << region.area << ' ';
    if (region.section) {
      out << region.section->name << ' ' << region.section->area << ' ' << region.section->inertia_y
          << ' ' << region.section->inertia_z << ' ' << region.section->torsion << ' '
          << region.section->z_axis[0];
    }
    if (region.damping) {
      out << region.damping->alpha << ' ' << region.damping->beta;
    }
    out << '\n';
  }
}

void describe(std::ostream& out, const std::optional<MotionComponent>& motion) {
  if (!motion) {
    out << "no motion\n";
    return;
  }
  out << motion->pga << ' ' << motion->scale << ' ';
  if (const auto* record = std::get_if<RecordedMotion>(&motion->source)) {
    out << record->file << ' ' << record->unit << ' ' << record->time_step << ' ' << record->column;
  } else {
    const auto& target = std::get<SyntheticMotion>(motion->source);
    out << target.target << ' ' << target.seed << ' ' << target.duration << ' '
        << target.envelope[0] << ' ' << target.envelope[1];
  }
  out << '\n';
}

/// Every bit of a scene of the pair's kind, as text.
std::string description(const Scene& scene) {
  std::ostringstream out;
  out << std::hexfloat << scene.title << '\n';
  for (const Structure& structure : scene.structures) {
    describe(out, structure);
  }
  for (const Contact& contact : scene.contacts) {
    out << contact.name << ' ' << contact.secondary.structure << ':' << contact.secondary.group
        << ' ' << contact.primary.structure << ':' << contact.primary.group << ' ';
    for (const double gap : contact.gap.values) {
      out << gap << ' ';
    }
    out << '\n';
  }
  for (const auto& component : scene.motion) {
    describe(out, component);
  }
  for (const Probe& probe : scene.probes) {
    out << probe.name << ' ' << probe.structure << ' ' << probe.group << ' ' << probe.average
        << ' ';
    for (const Vector3& point : probe.points) {
      out << point[0] << ' ' << point[1] << ' ' << point[2] << ' ';
    }
    out << '\n';
  }
  for (const double frequency : scene.spectra.frequencies) {
    out << frequency << ' ';
  }
  out << scene.spectra.damping_ratios[0] << ' ' << static_cast<int>(scene.resampling) << ' '
      << static_cast<int>(scene.stiffness) << ' ' << scene.end_time << ' ' << scene.courant << ' '
      << scene.time_step << ' ' << scene.allow_unstable << ' ' << scene.modes << ' '
      << scene.gap_tolerance << ' ' << scene.impact_merge_time << ' ' << scene.output_interval
      << ' ' << scene.energy_interval << ' ' << scene.dry_run << ' ' << scene.output << ' '
      << scene.checkpoint_interval << ' ' << scene.checkpoint_steps << ' ' << scene.restart;
  return out.str();
}

void expect_round_trip(const OptionsDatabase& database) {
  const ReadScene first = read_scene(database);
  const ReadScene second = read_scene(read_flat_yaml(resolved_yaml(first.resolved)));
  EXPECT_EQ(description(first.scene), description(second.scene));
  EXPECT_EQ(first.resolved, second.resolved);
}

TEST(ResolvedOptions, SmallestSceneReadsBackAlike) {
  expect_round_trip(smallest());
}

TEST(ResolvedOptions, PairReadsBackAlike) {
  expect_round_trip(pair());
}

/// A synthetic motion must not come back as `record: none`, which would take it away.
TEST(ResolvedOptions, DampingOfGroupsAndTheStartReadBackAlike) {
  expect_round_trip(with(pair(), {{"tower_slab_damping_beta", "3e-5"},
                                  {"tower_column_damping_ratio", "0.02"},
                                  {"tower_column_damping_frequencies", "2,40"},
                                  {"tower_initial_displacement", "0.01,0,0"},
                                  {"tower_initial_velocity", "1,0,0"}}));
}

TEST(ResolvedOptions, SyntheticMotionStays) {
  const ReadScene first = read_scene(pair());
  const ReadScene second = read_scene(read_flat_yaml(resolved_yaml(first.resolved)));
  ASSERT_TRUE(second.scene.motion[0]);
  EXPECT_EQ(second.scene.motion[0]->pga, 1.4715);
}

TEST(ResolvedOptions, MotionThatWasTakenAwayStaysAway) {
  expect_round_trip(with(pair(), {{"motion_x_record", "none"}}));
  expect_round_trip(with(pair(), {{"motion_x_record", "el_centro.AT2"}}));
}

TEST(ResolvedOptions, BareFlagReadsBackAlike) {
  expect_round_trip(with(smallest(), {{"dry_run", ""}, {"allow_unstable", "yes"}}));
}

TEST(ResolvedOptions, CheckpointsReadBackAlike) {
  expect_round_trip(with(smallest(), {{"checkpoint_interval", "600"},
                                      {"checkpoint_steps", "1000"},
                                      {"restart", "results/checkpoint.h5"}}));
  EXPECT_EQ(read_scene(smallest()).scene.restart, "");
}

TEST(ResolvedOptions, SplitIntoNamesAndValues) {
  const OptionValues given{
      {"end_time", "25"}, {"title", "a: \"b\" \\ c"}, {"other", "a\n\tb\x1b\\n"}};
  const std::string yaml = resolved_yaml(given);
  EXPECT_TRUE(
      yaml.ends_with("end_time: \"25\"\ntitle: \"a: \\\"b\\\" \\\\ c\"\n"
                     "other: \"a\\n\\tb\\x1b\\\\n\"\n"))
      << yaml;
  EXPECT_EQ(parse_options_file(yaml, "resolved.yaml"), OptionsDatabase(given.begin(), given.end()));
}

TEST(ResolvedOptions, AwkwardTextReadsBackAlike) {
  const OptionsDatabase database =
      with(smallest(), {{"title", "a: #b 'c' \"d\" \\e {f} [g] %\tend"}, {"output", "null"}});
  expect_round_trip(database);
  EXPECT_EQ(read_scene(database).scene.title, database.at("title"));
}

TEST(ResolvedOptions, HoldTheDefaults) {
  const OptionsDatabase resolved = read_flat_yaml(resolved_yaml(read_scene(smallest()).resolved));
  for (const char* name :
       {"courant", "modes", "output_interval", "tower_clamp", "tower_model", "tower_damping_alpha",
        "motion_y_record", "spectra_frequencies", "dry_run"}) {
    EXPECT_TRUE(resolved.contains(name)) << name;
  }
  EXPECT_EQ(resolved.at("courant"), "0.9");
}

TEST(ResolvedOptions, KeepTheLibrariesOptionsAndDropWhatIsNotUsed) {
  const OptionsDatabase resolved = read_flat_yaml(resolved_yaml(
      read_scene(with(pair(), {{"lowest_st_mat_mumps_icntl_14", "50"}, {"contacts", "floor2"}}))
          .resolved));
  EXPECT_EQ(resolved.at("lowest_st_mat_mumps_icntl_14"), "50");
  EXPECT_FALSE(resolved.contains("floor1_primary"));
  EXPECT_TRUE(resolved.contains("floor2_primary"));
}

}  // namespace resolved_options_test
}  // namespace pounding::scene_cases
