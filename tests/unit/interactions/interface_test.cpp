#include <gtest/gtest.h>

#include "common/error.h"
#include "interactions/pairing/contact_face.h"
#include "interactions/pairing/find_interface.h"
#include "support/box_mesh.h"

namespace pounding::interactions {
namespace interface_test {

Scene two_boxes(std::vector<double> gap = {}) {
  Scene scene;
  scene.structures = {testing_support::solid_structure("left", 1, 0, 1),
                      testing_support::solid_structure("right", 1, 0, 1)};
  Contact contact;
  contact.name = "face";
  contact.secondary = {"left", "x_max"};
  contact.primary = {"right", "x_min"};
  contact.gap.values = std::move(gap);
  scene.contacts.push_back(contact);
  return scene;
}

TEST(Interface, MatchedFacesPairNodeToNodeWithGapFromGeometry) {
  const std::vector<GlobalMesh> meshes{
      testing_support::box_mesh({0, 0, 0}, {2, 3, 1}, {2, 3, 1}),
      testing_support::box_mesh({2.05, 0, 0}, {1, 3, 1}, {1, 3, 1})};
  const Interface interface = find_interface(two_boxes(), meshes);
  ASSERT_EQ(interface.constraints.size(), 8u);
  EXPECT_EQ(interface.reports[0].matched, 8);
  EXPECT_NEAR(interface.reports[0].normal[0], 1, 1e-15);
  for (const Constraint& constraint : interface.constraints) {
    ASSERT_EQ(constraint.terms.size(), 2u);
    EXPECT_NEAR(constraint.initial_gap, 0.05, 1e-14);
    EXPECT_EQ(constraint.terms[0].structure, 1);
    EXPECT_DOUBLE_EQ(constraint.terms[0].coefficient, 1);
    EXPECT_EQ(constraint.terms[1].structure, 0);
    EXPECT_DOUBLE_EQ(constraint.terms[1].coefficient, -1);
  }
}

TEST(Interface, UnmatchedFacesWeighThePrimaryNodesToOne) {
  const std::vector<GlobalMesh> meshes{testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 3, 3}),
                                       testing_support::box_mesh({1, 0, 0}, {1, 1, 1}, {1, 2, 2})};
  const Interface interface = find_interface(two_boxes(), meshes);
  ASSERT_EQ(interface.constraints.size(), 16u);
  for (const Constraint& constraint : interface.constraints) {
    double sum = 0;
    Vector3 place{0, 0, 0};
    for (const ConstraintTerm& term : constraint.terms) {
      if (term.structure == 1) {
        sum += term.coefficient;
        const Vector3 x = meshes[1].position(term.node);
        place[1] += term.coefficient * x[1];
        place[2] += term.coefficient * x[2];
      }
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(place[1], constraint.place[0], 1e-12);
    EXPECT_NEAR(place[2], constraint.place[1], 1e-12);
  }
}

TEST(Interface, CornerGapsAreBilinearOnTheFace) {
  const std::vector<GlobalMesh> meshes{testing_support::box_mesh({0, 0, 0}, {1, 2, 1}, {1, 4, 2}),
                                       testing_support::box_mesh({1, 0, 0}, {1, 2, 1}, {1, 4, 2})};
  const Interface interface = find_interface(two_boxes({0.01, 0.02, 0.05, 0.03}), meshes);
  for (const Constraint& constraint : interface.constraints) {
    const double s = constraint.place[0] / 2;
    const double t = constraint.place[1];
    const double expected = (0.01 * (1 - s) + 0.02 * s) * (1 - t) + (0.03 * (1 - s) + 0.05 * s) * t;
    EXPECT_NEAR(constraint.initial_gap, expected, 1e-15);
    EXPECT_NEAR(constraint.geometric_gap, 0, 1e-15);
  }
  EXPECT_EQ(interface.reports[0].smallest_gap, 0.01);
  EXPECT_EQ(interface.reports[0].largest_gap, 0.05);
}

TEST(Interface, OverlappingBodiesHaveANegativeGap) {
  const std::vector<GlobalMesh> meshes{
      testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}),
      testing_support::box_mesh({0.999, 0, 0}, {1, 1, 1}, {1, 1, 1})};
  const Interface interface = find_interface(two_boxes(), meshes);
  for (const Constraint& constraint : interface.constraints) {
    EXPECT_NEAR(constraint.initial_gap, -1e-3, 1e-15);
  }
}

TEST(Interface, EccentricFacesReportTheNodesThatFaceNothing) {
  const std::vector<GlobalMesh> meshes{testing_support::box_mesh({0, 0, 0}, {1, 4, 1}, {1, 4, 1}),
                                       testing_support::box_mesh({1, 2, 0}, {1, 4, 1}, {1, 4, 1})};
  const Interface interface = find_interface(two_boxes(), meshes);
  EXPECT_EQ(interface.reports[0].pairs, 6);
  EXPECT_EQ(interface.reports[0].unmatched_nodes, 4);
}

TEST(Interface, TwoPassesConstrainTheNodesOfBothSides) {
  const std::vector<GlobalMesh> meshes{
      testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 3, 3}),
      testing_support::box_mesh({1.01, 0, 0}, {1, 1, 1}, {1, 2, 2})};
  Scene scene = two_boxes();
  scene.contacts[0].passes = 2;
  const Interface interface = find_interface(scene, meshes);
  ASSERT_EQ(interface.constraints.size(), 16u + 9u - 4u);  // corners face each other
  for (const Constraint& constraint : interface.constraints) {
    // A rigid motion of the right body by +1 along x opens every constraint by 1, whoever's node.
    double right = 0;
    double left = 0;
    for (const ConstraintTerm& term : constraint.terms) {
      (term.structure == 1 ? right : left) += term.component == 0 ? term.coefficient : 0;
    }
    EXPECT_NEAR(right, 1, 1e-12);
    EXPECT_NEAR(left, -1, 1e-12);
    EXPECT_NEAR(constraint.initial_gap, 0.01, 1e-12);
  }
}

TEST(Interface, AWallNeedsNothingButTheFaceAndItsDistance) {
  const std::vector<GlobalMesh> meshes{testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 2, 2}),
                                       testing_support::box_mesh({9, 0, 0}, {1, 1, 1}, {1, 1, 1})};
  Scene scene = two_boxes({0.3});
  scene.contacts[0].secondary.group = "x_min";
  scene.contacts[0].primary = {"wall", ""};
  const Interface interface = find_interface(scene, meshes);
  ASSERT_EQ(interface.constraints.size(), 9u);
  for (const Constraint& constraint : interface.constraints) {
    ASSERT_EQ(constraint.terms.size(), 1u);
    // Moving towards -x, out of the face and into the wall, closes the gap.
    EXPECT_DOUBLE_EQ(constraint.terms[0].coefficient, 1);
    EXPECT_DOUBLE_EQ(constraint.initial_gap, 0.3);
  }
}

/// A strip of shell quadrangles in the plane z, with the edges "x_min" and "x_max".
GlobalMesh shell_strip(double x, double z, double width, int cells) {
  GlobalMesh mesh;
  ElementSet set;
  set.group = "slab";
  set.type = ElementType::shell4;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i < 2; ++i) {
      mesh.node_tags.push_back(2 * j + i + 1);
      mesh.coordinates.insert(mesh.coordinates.end(), {x + i, width * j / cells, z});
    }
  }
  for (int j = 0; j < cells; ++j) {
    set.tags.push_back(j + 1);
    set.connectivity.insert(set.connectivity.end(), {2 * j, 2 * j + 1, 2 * j + 3, 2 * j + 2});
    for (int i = 0; i < 2; ++i) {
      Facet facet;
      facet.nodes = {2 * j + i, 2 * j + i + 2, -1, -1};
      facet.count = 2;
      NodeGroup& group = mesh.groups[i == 0 ? "x_min" : "x_max"];
      group.facets.push_back(facet);
      group.nodes.insert(group.nodes.end(), facet.nodes.begin(), facet.nodes.begin() + 2);
    }
  }
  mesh.regions.push_back(std::move(set));
  mesh.components.assign(mesh.node_tags.size(), 0x3f);
  mesh.free_components = mesh.components;
  return mesh;
}

TEST(Interface, ShellEdgesMeetInTheirPlaneAndWithinTheirThickness) {
  Scene scene = two_boxes();
  for (Structure& structure : scene.structures) {
    structure.regions[0].thickness = 0.2;
  }
  // Three cells against two: node to edge; the planes 0.15 m apart, less than the mean thickness.
  const std::vector<GlobalMesh> near{shell_strip(0, 0, 3, 3), shell_strip(1.05, 0.15, 3, 2)};
  const Interface interface = find_interface(scene, near);
  ASSERT_EQ(interface.constraints.size(), 4u);
  EXPECT_EQ(interface.reports[0].matched, 2);  // the ends
  for (const Constraint& constraint : interface.constraints) {
    EXPECT_NEAR(constraint.initial_gap, 0.05, 1e-14);
    for (const ConstraintTerm& term : constraint.terms) {
      EXPECT_EQ(term.component, 0);
    }
  }
  const std::vector<GlobalMesh> apart{shell_strip(0, 0, 3, 3), shell_strip(1.05, 0.25, 3, 2)};
  EXPECT_THROW(find_interface(scene, apart), UserError);
}

TEST(Interface, RefusesFacesThatLookAway) {
  const std::vector<GlobalMesh> meshes{testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}),
                                       testing_support::box_mesh({2, 0, 0}, {1, 1, 1}, {1, 1, 1})};
  Scene scene = two_boxes();
  scene.contacts[0].primary.group = "x_max";
  EXPECT_THROW(find_interface(scene, meshes), UserError);
  scene.contacts[0].primary.group = "nowhere";
  EXPECT_THROW(find_interface(scene, meshes), UserError);
}

/// Two cubes of 1 m face to face, 2 m in all, with a gap given.
Interface cubes_with_gap(double gap, bool wall = false) {
  const GlobalMesh left = testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  Scene scene = two_boxes({gap});
  if (wall) {
    scene.contacts[0].primary = {"wall", ""};
  }
  return find_interface(
      scene, std::vector{left, testing_support::box_mesh({1, 0, 0}, {1, 1, 1}, {1, 1, 1})});
}

TEST(Interface, DoubtsGapsThatMayBeInAnotherUnit) {
  EXPECT_TRUE(cubes_with_gap(0.99).warnings.empty());
  ASSERT_EQ(cubes_with_gap(1.01).warnings.size(), 1u);  // half of the model
  EXPECT_NE(cubes_with_gap(1.01).warnings[0].find("gaps are in metres"), std::string::npos);
  EXPECT_TRUE(cubes_with_gap(1.99, true).warnings.empty());
  EXPECT_EQ(cubes_with_gap(2.01, true).warnings.size(), 1u);
}

TEST(Interface, CountsWhatOverlapsAndNotWhatTouches) {
  EXPECT_EQ(cubes_with_gap(0).reports[0].overlapping, 0);
  EXPECT_TRUE(cubes_with_gap(0).warnings.empty());
  EXPECT_TRUE(cubes_with_gap(-1e-9).warnings.empty());
  EXPECT_EQ(cubes_with_gap(-3e-9).warnings.size(), 1u);
  EXPECT_EQ(cubes_with_gap(-0.0039).reports[0].overlapping, 4);  // 0.002 of the model
  ASSERT_EQ(cubes_with_gap(-0.0039).warnings.size(), 1u);
  EXPECT_NE(cubes_with_gap(-0.0039).warnings[0].find("up to 3.9 mm at the start, at 4 of 4"),
            std::string::npos);
  EXPECT_THROW(cubes_with_gap(-0.0041), UserError);
}

TEST(ContactFace, MeetsASkewedFacetWhereItsMapSays) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  Facet facet = mesh.groups.at("x_max").facets[0];
  // A corner pulled within the plane: the map is bilinear, no longer affine.
  mesh.coordinates[static_cast<std::size_t>(3 * facet.nodes[2] + 1)] += 0.4;
  const std::array<double, 4> weights{0.12, 0.28, 0.42, 0.18};  // xi = 0.4, eta = 0.2
  Vector3 target{0, 0, 0};
  for (std::size_t a = 0; a < 4; ++a) {
    const Vector3 x = mesh.position(facet.nodes[a]);
    for (std::size_t d = 0; d < 3; ++d) {
      target[d] += weights[a] * x[d];
    }
  }
  const auto point =
      meet_facet(mesh, facet, {target[0] - 2, target[1], target[2]}, {1, 0, 0}, 1e-6);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->distance, 2, 1e-13);
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_NEAR(point->weights[a], weights[a], 1e-12);
  }
}

}  // namespace interface_test
}  // namespace pounding::interactions
