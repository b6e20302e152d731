#include "interactions/pairing/contact_face.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "interactions/pairing/find_interface.h"
#include "support/box_mesh.h"
#include "support/refusal.h"
#include "support/shell_mesh.h"

namespace pounding::interactions {
namespace contact_face_test {

constexpr double thickness = 0.2;

/// A wall in the plane x, from y = 0 to 2 and z = 0 to 1, of two quadrangles in the group "face".
/// `turned`: the second has its nodes the other way round.
GlobalMesh wall(double x, bool turned = false) {
  testing_support::ShellMesh mesh;
  mesh.add_shell(0, {{{x, 0, 0}, {x, 1, 0}, {x, 1, 1}, {x, 0, 1}}}, "face");
  std::array<Vector3, 4> second{{{x, 1, 0}, {x, 2, 0}, {x, 2, 1}, {x, 1, 1}}};
  if (turned) {
    std::ranges::reverse(second);
  }
  mesh.add_shell(0, second, "face");
  return mesh.mesh();
}

/// Where a floor from x to x + length (negative: to smaller x) meets walls of the other thickness
/// `above` and `below` it, at z = 1; the group "face" is their common edge.
GlobalMesh floor_at_wall(double x, double length, bool above, bool below) {
  testing_support::ShellMesh mesh;
  const Vector3 a{x, 0, 1};
  const Vector3 b{x, 1, 1};
  mesh.add_shell(0, {{a, b, {x + length, 1, 1}, {x + length, 0, 1}}});
  if (above) {
    mesh.add_shell(1, {{a, b, {x, 1, 2}, {x, 0, 2}}});
  }
  if (below) {
    mesh.add_shell(1, {{a, b, {x, 1, 0}, {x, 0, 0}}});
  }
  mesh.add_facet("face", std::array{a, b});
  return mesh.mesh();
}

Scene scene_of(std::vector<Structure> structures, const std::string& secondary = "face",
               const std::string& primary = "face") {
  Scene scene;
  scene.structures = std::move(structures);
  Contact& contact = scene.contacts.emplace_back();
  contact.name = "joint";
  contact.secondary = {scene.structures[0].name, secondary};
  contact.primary = {scene.structures[1].name, primary};
  return scene;
}

Scene two_walls(double second = thickness) {
  return scene_of({testing_support::shell_structure("left", {thickness}),
                   testing_support::shell_structure("right", {second})});
}

/// The one gap of all pairs, which push along +x.
double common_gap(const Interface& interface) {
  const double gap = interface.constraints.at(0).initial_gap;
  for (const Constraint& constraint : interface.constraints) {
    EXPECT_NEAR(constraint.initial_gap, gap, 1e-14);
    for (const ConstraintTerm& term : constraint.terms) {
      EXPECT_EQ(term.component, 0);
      EXPECT_EQ(term.coefficient > 0, term.structure == 1);
    }
  }
  return gap;
}

TEST(ContactFace, GapOfWallsIsThatBetweenTheirSurfaces) {
  const std::vector<GlobalMesh> meshes{wall(0), wall(0.25)};
  const Interface interface = find_interface(two_walls(), meshes);
  ASSERT_EQ(interface.constraints.size(), 6u);
  EXPECT_NEAR(common_gap(interface), 0.05, 1e-15);
  EXPECT_NEAR(interface.reports[0].half_thickness[0], 0.1, 1e-15);
  EXPECT_NEAR(interface.reports[0].half_thickness[1], 0.1, 1e-15);
  EXPECT_NEAR(common_gap(find_interface(two_walls(0.1), meshes)), 0.1, 1e-15);
}

TEST(ContactFace, GapThatTheUserGivesIsAsGivenWhateverTheThickness) {
  Scene scene = two_walls();
  scene.contacts[0].gap.values = {0.07};
  const std::vector<GlobalMesh> meshes{wall(0), wall(0.25)};
  EXPECT_EQ(common_gap(find_interface(scene, meshes)), 0.07);
}

TEST(ContactFace, WallBesideASolidLosesItsOwnHalfOnly) {
  const Scene scene = scene_of({testing_support::shell_structure("left", {thickness}),
                                testing_support::solid_structure("right", 1, 0, 1)},
                               "face", "x_min");
  const std::vector<GlobalMesh> meshes{
      wall(0), testing_support::box_mesh({0.25, 0, 0}, {1, 2, 1}, {1, 2, 1})};
  EXPECT_NEAR(common_gap(find_interface(scene, meshes)), 0.15, 1e-15);
}

TEST(ContactFace, WallsThatOverlapAreMetBehind) {
  const std::vector<GlobalMesh> meshes{wall(0), wall(0.199)};
  EXPECT_NEAR(common_gap(find_interface(two_walls(), meshes)), -0.001, 1e-15);
}

TEST(ContactFace, ShellsOfOneFaceLookToOneSideInWhateverOrderTheirNodesAre) {
  const std::vector<GlobalMesh> meshes{wall(0, true), wall(0.25, true)};
  const Interface interface = find_interface(two_walls(), meshes);
  ASSERT_EQ(interface.constraints.size(), 6u);
  EXPECT_NEAR(common_gap(interface), 0.05, 1e-15);
}

TEST(ContactFace, FloorEdgeAtAWallLooksAwayFromTheFloor) {
  // Whatever the order in the mesh, with walls above and below, or at the roof with one below.
  const Scene scene = scene_of({testing_support::shell_structure("left", {0.3, thickness}),
                                testing_support::shell_structure("right", {0.3, thickness})});
  for (const bool left_above : {true, false}) {
    for (const bool right_above : {true, false}) {
      const std::vector<GlobalMesh> meshes{floor_at_wall(0, -3, left_above, true),
                                           floor_at_wall(0.25, 3, right_above, true)};
      const Interface interface = find_interface(scene, meshes);
      ASSERT_EQ(interface.constraints.size(), 2u);
      // The walls across the normal are there with half of their thickness.
      EXPECT_NEAR(common_gap(interface), 0.05, 1e-15);
    }
  }
}

TEST(ContactFace, FloorEdgeAtAWallMeetsAFloorAloneAndAWallAlone) {
  const Scene scene = scene_of({testing_support::shell_structure("left", {0.3, thickness}),
                                testing_support::shell_structure("right", {thickness})});
  testing_support::ShellMesh lone;
  lone.add_shell(0, {{{0.25, 0, 1}, {0.25, 1, 1}, {3, 1, 1}, {3, 0, 1}}});
  lone.add_facet("face", std::array<Vector3, 2>{{{0.25, 0, 1}, {0.25, 1, 1}}});
  const GlobalMesh roof = floor_at_wall(0, -3, false, true);
  EXPECT_NEAR(common_gap(find_interface(scene, std::vector{roof, lone.mesh()})), 0.15, 1e-15);
  EXPECT_NEAR(common_gap(find_interface(scene, std::vector{roof, wall(0.25)})), 0.05, 1e-15);
}

TEST(ContactFace, FloorEdgeAtAWallBesideARigidWallMustBePlain) {
  Scene scene = scene_of({testing_support::shell_structure("left", {0.3, thickness}),
                          testing_support::shell_structure("right", {0.3, thickness})});
  scene.contacts[0].primary = {"wall", ""};
  scene.contacts[0].gap.values = {0.01};
  const GlobalMesh other = floor_at_wall(1, 3, true, true);
  const std::vector<GlobalMesh> between{floor_at_wall(0, -3, true, true), other};
  const Interface interface = find_interface(scene, between);
  EXPECT_EQ(interface.reports[0].normal, (Vector3{1, 0, 0}));
  const std::vector<GlobalMesh> roof{floor_at_wall(0, -3, false, true), other};
  EXPECT_THROW(find_interface(scene, roof), UserError);
}

/// A trough of three boxes around y = 0, open above: the group "face" is what looks inside, walls
/// at x = -0.15 and `ahead`.
GlobalMesh trough(double ahead) {
  GlobalMesh mesh = testing_support::box_mesh({-1.15, 0, -1}, {1, 1, 3}, {1, 1, 3});
  const GlobalMesh other = testing_support::box_mesh({ahead, 0, -2}, {1, 1, 4}, {1, 1, 4});
  const auto first = mesh.node_count();
  const auto shifted = [&](GlobalIndex node) { return node + first; };
  mesh.coordinates.insert(mesh.coordinates.end(), other.coordinates.begin(),
                          other.coordinates.end());
  for (const std::int64_t tag : other.node_tags) {
    mesh.node_tags.push_back(tag + first);
  }
  ElementSet& set = mesh.regions[0];
  for (const GlobalIndex node : other.regions[0].connectivity) {
    set.connectivity.push_back(shifted(node));
  }
  set.tags.insert(set.tags.end(), other.regions[0].tags.begin(), other.regions[0].tags.end());
  NodeGroup face = mesh.groups.at("x_max");
  for (Facet facet : other.groups.at("x_min").facets) {
    std::ranges::transform(facet.corners(), facet.nodes.begin(), shifted);
    face.facets.push_back(facet);
    face.nodes.insert(face.nodes.end(), facet.nodes.begin(), facet.nodes.end());
  }
  std::ranges::sort(face.nodes);
  face.nodes.erase(std::unique(face.nodes.begin(), face.nodes.end()), face.nodes.end());
  mesh.groups["face"] = face;
  mesh.components.assign(mesh.node_tags.size(), 0x07);
  mesh.free_components = mesh.components;
  return mesh;
}

TEST(ContactFace, WallAheadIsMetAndNotTheNearerOneBehind) {
  // A body 0.1 m wide in a trough: its face has one wall 0.15 m behind and one 0.2 m ahead.
  Scene scene = scene_of({testing_support::solid_structure("left", 1, 0, 1),
                          testing_support::solid_structure("right", 1, 0, 1)},
                         "x_max", "face");
  const std::vector<GlobalMesh> meshes{
      testing_support::box_mesh({-0.1, 0, 0}, {0.1, 1, 1}, {1, 1, 1}), trough(0.2)};
  // The longer wall decides where the whole looks.
  const Interface interface = find_interface(scene, meshes);
  ASSERT_EQ(interface.constraints.size(), 4u);
  EXPECT_NEAR(common_gap(interface), 0.2, 1e-14);
}

TEST(ContactFace, FacesThatLookAwayFromEachOtherAreRefusedWithTheDistance) {
  Scene scene = scene_of({testing_support::solid_structure("left", 1, 0, 1),
                          testing_support::solid_structure("right", 1, 0, 1)},
                         "x_min", "x_max");
  const std::vector<GlobalMesh> meshes{
      testing_support::box_mesh({0, 0, 0}, {3, 1, 1}, {3, 1, 1}),
      testing_support::box_mesh({3.05, 0, 0}, {3, 1, 1}, {3, 1, 1})};
  EXPECT_NE(
      testing_support::refusal_of([&] { find_interface(scene, meshes); }).find("by up to 6.05 m"),
      std::string::npos);
}

TEST(ContactFace, FacetInsideABodyIsCounted) {
  Scene scene = scene_of({testing_support::solid_structure("left", 1, 0, 1),
                          testing_support::solid_structure("right", 1, 0, 1)},
                         "inner", "x_min");
  GlobalMesh left = testing_support::box_mesh({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  Facet facet;
  facet.count = 4;
  for (GlobalIndex n = 0, k = 0; n < left.node_count(); ++n) {
    if (left.position(n)[0] == 1) {
      facet.nodes[static_cast<std::size_t>(k++)] = n;
    }
  }
  std::swap(facet.nodes[2], facet.nodes[3]);
  left.groups["inner"] = {{facet.corners().begin(), facet.corners().end()}, {facet}};
  const std::vector<GlobalMesh> meshes{
      left, testing_support::box_mesh({2.1, 0, 0}, {1, 1, 1}, {1, 1, 1})};
  const Interface interface = find_interface(scene, meshes);
  EXPECT_EQ(interface.reports[0].inner_facets, 1);
  ASSERT_EQ(interface.warnings.size(), 1u);
  EXPECT_NE(interface.warnings[0].find("1 facets have elements on both"), std::string::npos);
}

}  // namespace contact_face_test
}  // namespace pounding::interactions
