#include "scene/doubts.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pounding {
namespace doubts_test {

using ::testing::HasSubstr;

/// A clamped frame whose numbers are those of a building.
Scene building() {
  const Material steel{"steel", 200e9, 0.3, 7800};
  Region columns;
  columns.group = "columns";
  columns.element = ElementType::beam;
  columns.material = steel;
  columns.section = Section{"heb120", 34e-4, 318e-8, 864e-8, 14e-8, {1, 0, 0}};
  Region slab;
  slab.group = "slab";
  slab.element = ElementType::shell4;
  slab.material = {"concrete", 30e9, 0.2, 2400};
  slab.thickness = 0.22;
  Region brace;
  brace.group = "brace";
  brace.element = ElementType::tension_bar;
  brace.material = steel;
  brace.area = 117e-6;
  Region mass;
  mass.group = "machine";
  mass.element = ElementType::point_mass;
  mass.mass = 100;
  Structure tower;
  tower.name = "tower";
  tower.clamps = {{"base"}};
  tower.regions = {columns, slab, brace, mass};
  Scene scene;
  scene.structures = {tower};
  return scene;
}

std::vector<std::string> changed(const std::function<void(Structure&)>& change) {
  Scene scene = building();
  change(scene.structures[0]);
  return scene_doubts(scene);
}

TEST(SceneDoubts, NoneAboutABuilding) {
  EXPECT_TRUE(scene_doubts(building()).empty());
  // A containment building as a stick: radius of gyration 14 m.
  EXPECT_TRUE(changed([](Structure& s) {
                s.regions[0].section = Section{"stick", 125, 25000, 25000, 50000, {1, 0, 0}};
              }).empty());
}

TEST(SceneDoubts, OneLineForEachWrongUnit) {
  const auto expect_one = [](const std::function<void(Structure&)>& change,
                             const std::string& what) {
    const auto doubts = changed(change);
    ASSERT_EQ(doubts.size(), 1u) << what;
    EXPECT_THAT(doubts[0], HasSubstr(what));
  };
  expect_one([](Structure& s) { s.regions[1].material.young = 30e3; },
             "material concrete: young 30000 Pa is outside 1e+08 to 1e+12 Pa");
  expect_one([](Structure& s) { s.regions[1].material.young = 30e15; }, "young");
  expect_one([](Structure& s) { s.regions[1].material.density = 2.5; },
             "material concrete: density 2.5 kg/m3");
  expect_one([](Structure& s) { s.regions[1].material.density = 2.4e6; }, "density");
  expect_one([](Structure& s) { s.regions[1].material.poisson = 0.499; }, "poisson 0.499");
  expect_one([](Structure& s) { s.regions[1].thickness = 200; },
             "structure tower, group slab: thickness 200 m");
  expect_one([](Structure& s) { s.regions[2].area = 117; }, "group brace: area 117 m2");
  expect_one([](Structure& s) { s.regions[3].nonlinear.radius = 2500; },
             "group machine: pendulum_radius 2500 m");
  expect_one(
      [](Structure& s) {
        s.soil.emplace();
        s.soil->ground.shear_velocity = 300;
        s.soil->ground.density = 2000;
        s.soil->embedment = 1e4;
      },
      "soil_embedment 10000 m");
  // A material that two groups share is named once.
  expect_one(
      [](Structure& s) {
        s.regions[0].material.young = 200e3;
        s.regions[2].material.young = 200e3;
      },
      "material steel");
}

TEST(SceneDoubts, AreaAndInertiasOfDifferentUnits) {
  const auto with = [](double area, double inertia) {
    return changed([&](Structure& s) {
      s.regions[0].section = Section{"heb120", area, inertia, inertia, 14e-8, {1, 0, 0}};
    });
  };
  for (const auto& [area, inertia] : {std::pair{34e-4, 864.0},  // cm4
                                      {34e-4, 864e4},           // mm4
                                      {34.0, 864e-8},           // cm2
                                      {3400.0, 864e4}}) {       // mm2 and mm4
    const auto doubts = with(area, inertia);
    ASSERT_EQ(doubts.size(), 2u) << area << " " << inertia;
    EXPECT_THAT(doubts[0], HasSubstr("section heb120, sqrt(inertia_y / area): radius of gyration"));
  }
}

TEST(SceneDoubts, GravityDroppedOnWhatIsHeld) {
  const auto with = [](Vector3 gravity, std::uint8_t components) {
    return changed([&](Structure& s) {
      s.gravity = gravity;
      s.clamps[0].components = components;
    });
  };
  ASSERT_EQ(with({0, 0, -9.81}, 0x3f).size(), 1u);
  EXPECT_THAT(with({0, 0, -9.81}, 0x3f)[0], HasSubstr("drop test"));
  EXPECT_TRUE(with({0, 0, -9.81}, 0x03).empty());  // a plane of symmetry: it falls on a contact
  EXPECT_TRUE(with({0, 0, 0}, 0x3f).empty());
  const auto sprung = changed([](Structure& s) {
    s.gravity = {0, 0, -9.81};
    s.clamps.clear();
    s.regions[3].element = ElementType::grounded_spring;
    s.regions[3].stiffness = {0, 0, 1e6, 0, 0, 0};
  });
  EXPECT_EQ(sprung.size(), 1u);
}

/// A raft on springs that may lift off, and bearings that slide in the plane x-y.
void add_bearings(Structure& structure) {
  Region raft;
  raft.group = "raft";
  raft.element = ElementType::grounded_spring;
  raft.stiffness = {1e6, 1e6, 1e8};
  raft.compression_only = true;
  Region sliders = raft;
  sliders.group = "sliders";
  sliders.compression_only = false;
  sliders.nonlinear.circle = {0, 1, 2};
  sliders.nonlinear.friction = 0.08;
  structure.regions.push_back(raft);
  structure.regions.push_back(sliders);
}

TEST(SceneDoubts, NothingPressesWithoutWeight) {
  const std::vector<std::string> lines = changed(add_bearings);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], HasSubstr("group raft: pushes up only, but no gravity"));
  EXPECT_THAT(lines[1], HasSubstr("group sliders: slides, but no gravity acts along z"));
  Scene heavy = building();
  add_bearings(heavy.structures[0]);
  heavy.structures[0].gravity = {0, 0, -9.81};
  heavy.preload = true;
  EXPECT_TRUE(scene_doubts(heavy).empty());
}

}  // namespace doubts_test
}  // namespace pounding
