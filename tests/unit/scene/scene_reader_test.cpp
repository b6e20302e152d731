#include "scene/scene_reader.h"

#include <numbers>

#include "common/error.h"
#include "scene_cases.h"

namespace pounding::scene_cases {
namespace scene_reader_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(SceneReader, SmallestSceneHoldsTheDefaults) {
  const Scene scene = read_scene(smallest()).scene;
  EXPECT_EQ(scene.title, "");
  EXPECT_EQ(scene.end_time, 2);
  EXPECT_EQ(scene.courant, 0.9);
  EXPECT_EQ(scene.time_step, 0);
  EXPECT_FALSE(scene.allow_unstable);
  EXPECT_EQ(scene.modes, 12);
  EXPECT_EQ(scene.gap_tolerance, 1e-12);
  EXPECT_EQ(scene.impact_merge_time, 1e-3);
  EXPECT_EQ(scene.output_interval, 5e-5);
  EXPECT_EQ(scene.energy_interval, 100);
  EXPECT_FALSE(scene.dry_run);
  EXPECT_EQ(scene.output, "results");
  EXPECT_EQ(scene.resampling, Resampling::linear);
  EXPECT_TRUE(scene.contacts.empty());
  EXPECT_TRUE(scene.probes.empty());
  for (const auto& component : scene.motion) {
    EXPECT_FALSE(component);
  }
  EXPECT_THAT(scene.spectra.damping_ratios, ElementsAre(0.05));
  EXPECT_EQ(scene.spectra.frequencies.size(), 200U);
  ASSERT_EQ(scene.structures.size(), 1U);
  const Structure& tower = scene.structures[0];
  EXPECT_EQ(tower.mesh, "tower.geo");
  EXPECT_TRUE(tower.mesh_set.empty());
  EXPECT_TRUE(tower.clamps.empty());
  EXPECT_EQ(tower.damping.alpha, 0);
  EXPECT_EQ(tower.damping.beta, 0);
  EXPECT_THAT(tower.initial_displacement, ElementsAre(0, 0, 0));
  EXPECT_THAT(tower.initial_velocity, ElementsAre(0, 0, 0));
}

TEST(SceneReader, StructuresOfThePair) {
  const Scene scene = read_scene(pair()).scene;
  EXPECT_EQ(scene.title, "Pair: \"2 cm\", 0.15 g");
  ASSERT_EQ(scene.structures.size(), 2U);
  const Structure& tower = scene.structures[0];
  EXPECT_EQ(tower.name, "tower");
  EXPECT_THAT(tower.mesh_set, ElementsAre(Pair("h", "0.12"), Pair("slab", "hex")));
  ASSERT_EQ(tower.clamps.size(), 2U);
  EXPECT_EQ(tower.clamps[0].group, "base");
  EXPECT_EQ(tower.clamps[0].components, 0b111111);
  EXPECT_EQ(tower.clamps[1].group, "core");
  EXPECT_EQ(tower.clamps[1].components, 0b001010);  // rx and y
  EXPECT_EQ(tower.damping.alpha, 0.1562);
  EXPECT_EQ(tower.damping.beta, 1.2557e-5);
  ASSERT_EQ(tower.regions.size(), 3U);
  const Region& brace = tower.regions[0];
  EXPECT_EQ(brace.group, "brace");
  EXPECT_EQ(brace.element, ElementType::bar);
  EXPECT_EQ(brace.area, 1.17e-4);
  EXPECT_EQ(brace.material.young, 200e9);
  const Region& column = tower.regions[1];
  EXPECT_EQ(column.element, ElementType::beam);
  ASSERT_TRUE(column.section);
  EXPECT_EQ(column.section->name, "heb120");
  EXPECT_EQ(column.section->area, 34.01e-4);
  EXPECT_EQ(column.section->inertia_y, 317.5e-8);
  EXPECT_EQ(column.section->inertia_z, 864.4e-8);
  EXPECT_EQ(column.section->torsion, 13.84e-8);
  EXPECT_THAT(column.section->z_axis, ElementsAre(1, 0, 0));
  const Region& slab = tower.regions[2];
  EXPECT_EQ(slab.element, ElementType::hex8);
  EXPECT_FALSE(slab.section);
  EXPECT_EQ(slab.material.name, "concrete");
  EXPECT_EQ(slab.material.poisson, 0.2);
  EXPECT_EQ(slab.material.density, 2400);
  EXPECT_EQ(scene.structures[1].regions[0].element, ElementType::hex8_full);
}

TEST(SceneReader, ContactsMotionAndProbesOfThePair) {
  const Scene scene = read_scene(pair()).scene;
  ASSERT_EQ(scene.contacts.size(), 2U);
  EXPECT_TRUE(scene.contacts[0].gap.values.empty());
  EXPECT_THAT(scene.contacts[1].gap.values, ElementsAre(0.025, -0.001));
  EXPECT_EQ(scene.contacts[1].secondary.structure, "tower");
  EXPECT_EQ(scene.contacts[1].primary.group, "face2");

  ASSERT_TRUE(scene.motion[0]);
  EXPECT_EQ(scene.motion[0]->pga, 1.4715);
  const auto& synthetic = std::get<SyntheticMotion>(scene.motion[0]->source);
  EXPECT_EQ(synthetic.target, "alluvial.csv");
  EXPECT_EQ(synthetic.seed, 7);
  EXPECT_EQ(synthetic.duration, 25);
  EXPECT_THAT(synthetic.envelope, ElementsAre(2, 15));
  EXPECT_FALSE(scene.motion[1]);
  ASSERT_TRUE(scene.motion[2]);
  EXPECT_EQ(scene.motion[2]->scale, -0.5);
  EXPECT_EQ(scene.motion[2]->pga, 0);
  const auto& record = std::get<RecordedMotion>(scene.motion[2]->source);
  EXPECT_EQ(record.file, "vertical.AT2");
  EXPECT_EQ(record.unit, "g");

  ASSERT_EQ(scene.probes.size(), 2U);
  EXPECT_THAT(scene.probes[0].points,
              ElementsAre(ElementsAre(0.12, 0.12, 5.22), ElementsAre(3.24, 0.12, 5.22)));
  EXPECT_TRUE(scene.probes[0].average);
  EXPECT_EQ(scene.probes[1].group, "base");
  EXPECT_FALSE(scene.probes[1].average);
}

/// A uniform damping of 0 is none: it takes back what an included file says.
TEST(SceneReader, UniformDampingOfZeroStandsBesideRayleighDamping) {
  const auto tower = [](const char* uniform) {
    return read_scene(with(pair(), {{"tower_damping_uniform", uniform}})).scene.structures[0];
  };
  EXPECT_FALSE(tower("0").uniform_damping);
  EXPECT_EQ(tower("0").damping.beta, 1.2557e-5);
  EXPECT_THROW(tower("0.02"), UserError);
}

/// Rayleigh damping has the damping ratio xi(w) = alpha / (2 w) + beta w / 2.
TEST(SceneReader, DampingRatioHoldsAtBothFrequencies) {
  const Rayleigh damping = read_scene(pair()).scene.structures[1].damping;
  for (const double frequency : {2.1, 150.0}) {
    const double w = 2 * std::numbers::pi * frequency;
    EXPECT_NEAR(damping.alpha / (2 * w) + damping.beta * w / 2, 0.006, 1e-15);
  }
  const double between = 2 * std::numbers::pi * 20;
  EXPECT_LT(damping.alpha / (2 * between) + damping.beta * between / 2, 0.006);
}

TEST(SceneReader, StartOfAStructure) {
  const Structure tower =
      read_scene(with(smallest(), {{"tower_initial_displacement", "0.1,0,-2e-3"},
                                   {"tower_initial_velocity", "0,3,0"}}))
          .scene.structures[0];
  EXPECT_THAT(tower.initial_displacement, ElementsAre(0.1, 0, -2e-3));
  EXPECT_THAT(tower.initial_velocity, ElementsAre(0, 3, 0));
}

TEST(SceneReader, GapHasOneTwoOrFourValues) {
  EXPECT_THAT(read_scene(with(pair(), {{"floor1_gap", "0.02"}})).scene.contacts[0].gap.values,
              ElementsAre(0.02));
  EXPECT_THAT(read_scene(with(pair(), {{"floor1_gap", "1,2,3,4"}})).scene.contacts[0].gap.values,
              ElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(
      read_scene(with(pair(), {{"floor2_gap", "geometry"}})).scene.contacts[1].gap.values.empty());
}

TEST(SceneReader, RecordWinsOverTheTargetOfTheCase) {
  const Scene scene =
      read_scene(with(pair(), {{"motion_x_record", "el_centro.AT2"}, {"motion_x_column", "2"}}))
          .scene;
  ASSERT_TRUE(scene.motion[0]);
  EXPECT_EQ(std::get<RecordedMotion>(scene.motion[0]->source).file, "el_centro.AT2");
  EXPECT_EQ(std::get<RecordedMotion>(scene.motion[0]->source).column, 2);
  EXPECT_EQ(std::get<RecordedMotion>(scene.motion[0]->source).unit, "");
}

TEST(SceneReader, RecordNoneTakesTheMotionAway) {
  const Scene scene =
      read_scene(with(pair(), {{"motion_x_record", "none"}, {"motion_z_record", "none"}})).scene;
  EXPECT_FALSE(scene.motion[0]);
  EXPECT_FALSE(scene.motion[2]);
}

TEST(SceneReader, BareFlagSwitchesOn) {
  EXPECT_TRUE(read_scene(with(smallest(), {{"dry_run", ""}})).scene.dry_run);
  EXPECT_FALSE(read_scene(with(smallest(), {{"dry_run", "false"}})).scene.dry_run);
}

TEST(SceneReader, ContactsAndProbesCanBeSwitchedOff) {
  const Scene scene = read_scene(with(pair(), {{"contacts", "none"}, {"probes", "none"}})).scene;
  EXPECT_TRUE(scene.contacts.empty());
  EXPECT_TRUE(scene.probes.empty());
}

TEST(SceneReader, AStructureOfASceneCanBeTakenAlone) {
  const OptionsDatabase alone =
      with(pair(), {{"structures", "tower"}, {"contacts", "none"}, {"probes", "none"}});
  const Scene scene = read_scene(alone).scene;
  EXPECT_EQ(scene.structures.size(), 1U);
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("structure annex is defined")));
  expect_refused(with(alone, {{"annex_clomp", "base"}}), {"-annex_clomp", "-annex_clamp"});
}

TEST(SceneReader, SpectraOfTheirOwn) {
  const Scene scene = read_scene(with(smallest(), {{"spectra_damping", "0.02,0.05"},
                                                   {"spectra_frequencies", "1,2,5"}}))
                          .scene;
  EXPECT_THAT(scene.spectra.damping_ratios, ElementsAre(0.02, 0.05));
  EXPECT_THAT(scene.spectra.frequencies, ElementsAre(1, 2, 5));
}

}  // namespace scene_reader_test
}  // namespace pounding::scene_cases
