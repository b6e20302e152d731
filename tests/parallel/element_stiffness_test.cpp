#include "stiffness/element_stiffness.h"

#include <cmath>

#include <gtest/gtest.h>

#include "elements/measured_costs.h"
#include "support/box_mesh.h"
#include "support/built_stiffness.h"

namespace pounding {
namespace element_stiffness_test {

using testing_support::build_stiffness;
using testing_support::difference_to_assembled;
using testing_support::move_nodes;
using testing_support::random_field;

Structure concrete(ElementType type = ElementType::hex8) {
  return testing_support::solid_structure("box", 30e9, 0.2, 2400, type);
}

constexpr double tolerance = 1e-13;

TEST(ElementStiffness, FreeSlabOfBricks) {
  for (const ElementType type : {ElementType::hex8, ElementType::hex8_full}) {
    const auto built = build_stiffness(
        testing_support::box_mesh({0, 0, 0}, {3, 2.4, 0.22}, {6, 5, 1}, type), concrete(type));
    EXPECT_EQ(built.stiffness->kinds().bricks, 30);
    EXPECT_EQ(built.stiffness->kinds().other, 0);
    EXPECT_LT(difference_to_assembled(built), tolerance);
  }
}

TEST(ElementStiffness, RowsOfEveryLength) {
  for (int cells = 1; cells <= 9; ++cells) {
    const auto built = build_stiffness(
        testing_support::box_mesh({-1, 2, 0}, {0.3 * cells, 0.6, 0.5}, {cells, 2, 2}), concrete());
    EXPECT_LT(difference_to_assembled(built), tolerance) << cells << " cells";
  }
}

TEST(ElementStiffness, ClampedFace) {
  for (const char* face : {"x_min", "z_min"}) {
    GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2, 1, 1.5}, {7, 4, 5});
    testing_support::clamp(mesh, face);
    const auto built = build_stiffness(mesh, concrete());
    EXPECT_EQ(built.stiffness->kinds().bricks, 140);
    EXPECT_LT(difference_to_assembled(built), tolerance);
  }
}

TEST(ElementStiffness, SingleComponentsClamped) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2, 1, 1}, {5, 3, 2});
  for (std::size_t i = 0; i < mesh.free_components.size(); ++i) {
    mesh.free_components[i] = static_cast<std::uint8_t>(1 + i % 7);
  }
  EXPECT_LT(difference_to_assembled(build_stiffness(mesh, concrete())), tolerance);
}

TEST(ElementStiffness, CellsOfTwoSizes) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {8, 5, 1}, {8, 5, 1});
  move_nodes(mesh, [](Vector3 x) {
    return Vector3{x[0] + (x[0] > 2.5 ? 0.5 : 0), 0.5 * x[1] + (x[1] > 3.5 ? 0.1 : 0), x[2]};
  });
  const auto built = build_stiffness(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 40);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, NodesListedFromAnotherCorner) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {6, 5, 1}, {6, 5, 1});
  auto& list = mesh.regions[0].connectivity;
  for (std::size_t e = 0; e < list.size(); e += 16) {  // every second brick, turned about z
    std::rotate(&list[e], &list[e + 1], &list[e + 4]);
    std::rotate(&list[e + 4], &list[e + 5], &list[e + 8]);
  }
  const auto built = build_stiffness(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 30);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, BricksTurnedInSpace) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {3, 2, 1}, {7, 5, 2});
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  move_nodes(mesh, [=](Vector3 x) {
    const Vector3 y{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    return Vector3{y[0], c * y[1] - s * y[2], s * y[1] + c * y[2]};
  });
  const auto built = build_stiffness(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 70);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, ShearedMeshByItsStrains) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {3, 2, 1}, {7, 5, 2});
  move_nodes(mesh, [](Vector3 x) { return Vector3{x[0] + 0.3 * x[1], x[1], x[2]}; });
  testing_support::clamp(mesh, "z_min");
  const auto built = build_stiffness(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().general, 70);
  EXPECT_EQ(built.stiffness->kinds().bricks, 0);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, DistortedMesh) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {4, 3, 2}, {5, 4, 3});
  move_nodes(mesh, [](Vector3 x) {
    return Vector3{x[0] + 0.1 * std::sin(3 * x[1] + x[2]), x[1] + 0.1 * std::cos(2 * x[0] * x[2]),
                   x[2] + 0.05 * std::sin(5 * x[0])};
  });
  const auto built = build_stiffness(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().general, 60);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

/// Hexahedra of any shape cost what was measured beside extruded ones, which cost once.
TEST(ElementStiffness, CostBesideAnExtrudedMesh) {
  for (const bool skew : {false, true}) {
    GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {4, 3, 2}, {5, 4, 3});
    move_nodes(mesh, [skew](Vector3 x) {
      return Vector3{x[0] + 0.05 * std::sin(3 * x[1] + skew * x[2]), x[1], x[2]};
    });
    const auto built = testing_support::build_system(mesh, concrete());
    const LinearSystem system =
        pounding::build_system(concrete(), built.mesh, StiffnessMethod::automatic);
    const double expected = 1.0 * measured_costs::skew / measured_costs::extruded;
    EXPECT_NEAR(system.cost_beside_extruded, skew ? expected : 1, 1e-12);
  }
}

/// Bricks whose ends are alike, along every axis, from every corner and with nodes held in part.
TEST(ElementStiffness, ExtrudedMesh) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::size_t turns : {0, 1, 2}) {
      GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {4, 3, 2}, {5, 4, 3});
      move_nodes(mesh, [&](Vector3 x) {
        const std::size_t d = (axis + 1) % 3, e = (axis + 2) % 3;
        const double first = x[d];
        x[d] += 0.1 * std::sin(3 * x[e]);
        x[e] += 0.1 * std::cos(2 * first + x[e]);
        return x;
      });
      auto& list = mesh.regions[0].connectivity;
      constexpr std::array<std::size_t, 8> next{0, 3, 7, 4, 1, 2, 6, 5};  // about a diagonal
      for (std::size_t turn = 0; turn < turns; ++turn) {
        for (std::size_t e = 0; e < list.size(); e += 8) {
          const std::vector<GlobalIndex> nodes(&list[e], &list[e] + 8);
          for (std::size_t a = 0; a < 8; ++a) list[e + a] = nodes[next[a]];
        }
      }
      for (std::size_t i = 0; i < mesh.free_components.size(); i += 4) {
        mesh.free_components[i] = static_cast<std::uint8_t>(i % 8);
      }
      const auto built = build_stiffness(mesh, concrete());
      EXPECT_EQ(built.stiffness->kinds().general, 60);
      EXPECT_LT(difference_to_assembled(built), tolerance) << "axis " << axis << " turn " << turns;
    }
  }
}

/// A slab with a node out of place, and beams along two of its edges.
GlobalMesh slab_with_beams(Structure& structure) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {6, 5, 0.22}, {9, 7, 1});
  mesh.coordinates[3 * 11] += 0.1;
  ElementSet beams;
  beams.group = "beams";
  beams.region = 1;
  beams.type = ElementType::beam;
  const auto add = [&](GlobalIndex from, GlobalIndex to) {
    beams.tags.push_back(1000 + static_cast<std::int64_t>(beams.tags.size()));
    beams.connectivity.insert(beams.connectivity.end(), {from, to});
    for (const GlobalIndex node : {from, to}) {
      mesh.components[static_cast<std::size_t>(node)] = 0x3f;
    }
  };
  for (GlobalIndex i = 0; i < 9; ++i) add(i, i + 1);
  for (GlobalIndex j = 0; j < 7; ++j) add(10 * j + 9, 10 * j + 19);
  mesh.regions.push_back(beams);
  mesh.free_components = mesh.components;
  Region region = structure.regions[0];
  region.group = "beams";
  region.element = ElementType::beam;
  region.section = Section{"s", 0.09, 6.75e-4, 6.75e-4, 1.1e-3, {0.1, 0.2, 1}, 0.07, 0.04};
  structure.regions.push_back(region);
  return mesh;
}

TEST(ElementStiffness, SlabWithBeamsOnItsEdges) {
  Structure structure = concrete();
  const GlobalMesh mesh = slab_with_beams(structure);
  const auto built = build_stiffness(mesh, structure);
  EXPECT_EQ(built.stiffness->kinds().bricks, 63 - 4);
  EXPECT_EQ(built.stiffness->kinds().general, 4);
  EXPECT_EQ(built.stiffness->kinds().beams, 16);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, SameBitsOnEveryProduct) {
  Structure structure = concrete();
  const GlobalMesh mesh = slab_with_beams(structure);
  const auto built = build_stiffness(mesh, structure);
  const auto again = build_stiffness(mesh, structure);
  const std::vector<double> w = random_field(built.mesh, 5);
  std::vector<double> first(w.size(), 1.0);
  std::vector<double> second(w.size(), 2.0);
  std::vector<double> third(w.size(), 3.0);
  built.stiffness->apply(w.data(), first.data());
  built.stiffness->apply(w.data(), second.data());
  again.stiffness->apply(w.data(), third.data());
  EXPECT_EQ(first, second);
  EXPECT_EQ(first, third);
}

/// A structure of fewer nodes than ranks have room for leaves some ranks empty.
TEST(ElementStiffness, OneBrickOnAllRanks) {
  const auto built =
      build_stiffness(testing_support::box_mesh({0, 0, 0}, {1, 2, 3}, {1, 1, 1}), concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 1);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

}  // namespace element_stiffness_test
}  // namespace pounding
