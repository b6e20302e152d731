#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "support/built_stiffness.h"
#include "support/frame_mesh.h"

namespace pounding {
namespace shell_stiffness_test {

using testing_support::build_stiffness;
using testing_support::BuiltStiffness;
using testing_support::difference_to_assembled;
using testing_support::FrameMesh;
using testing_support::move_nodes;

constexpr double tolerance = 1e-13;

/// Turns a point about z, then about x.
Vector3 turned(const Vector3& x) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const Vector3 y{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
  return {y[0], c * y[1] - s * y[2], s * y[1] + c * y[2]};
}

BuiltStiffness build(FrameMesh& frame) {
  return build_stiffness(frame.mesh(), frame.structure());
}

FrameMesh one_plate(std::array<int, 2> cells) {
  FrameMesh frame;
  frame.add_plate({1, 2, 3}, {0.3 * cells[0], 0, 0}, {0, 0.25 * cells[1], 0}, cells, 0.22);
  return frame;
}

TEST(ShellStiffness, RowsOfEveryLength) {
  for (int cells = 1; cells <= 9; ++cells) {
    FrameMesh frame = one_plate({cells, 3});
    const auto built = build(frame);
    EXPECT_EQ(built.stiffness->kinds().rectangles, 3 * cells);
    EXPECT_EQ(built.stiffness->kinds().other, 0);
    EXPECT_LT(difference_to_assembled(built), tolerance) << cells << " cells";
  }
}

/// A floor and two walls that meet at their edges, of different thickness.
FrameMesh corner_of_a_house() {
  FrameMesh frame;
  frame.add_plate({0, 0, 0}, {3, 0, 0}, {0, 2.5, 0}, {10, 5}, 0.22);
  frame.add_plate({0, 0, 0}, {0, 0, 2}, {3, 0, 0}, {4, 10}, 0.1);
  frame.add_plate({0, 0, 0}, {0, 2.5, 0}, {0, 0, 2}, {5, 4}, 0.15);
  return frame;
}

TEST(ShellStiffness, PlatesInThreePlanesOfDifferentThickness) {
  FrameMesh frame = corner_of_a_house();
  const auto built = build(frame);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 50 + 40 + 20);
  EXPECT_EQ(built.stiffness->kinds().other, 0);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ShellStiffness, TurnedInSpace) {
  FrameMesh frame = corner_of_a_house();
  move_nodes(frame.mesh(), turned);
  const auto built = build(frame);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 50 + 40 + 20);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ShellStiffness, ClampedNodes) {
  FrameMesh frame = corner_of_a_house();
  for (int i = 0; i <= 10; ++i) frame.clamp({0.3 * i, 0, 2});
  for (int j = 0; j <= 5; ++j) frame.clamp({3, 0.5 * j, 0});
  const auto built = build(frame);
  EXPECT_LT(built.mesh.global_dofs, built.mesh.global_dofs_unclamped);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 50 + 40 + 20);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ShellStiffness, SingleComponentsClamped) {
  FrameMesh frame = corner_of_a_house();
  auto& free = frame.mesh().free_components;
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = static_cast<std::uint8_t>(1 + i % 63);
  EXPECT_LT(difference_to_assembled(build(frame)), tolerance);
}

TEST(ShellStiffness, CellsOfTwoSizes) {
  FrameMesh frame = one_plate({8, 5});
  move_nodes(frame.mesh(), [](Vector3 x) {
    return Vector3{x[0] + (x[0] > 2 ? 0.1 * (x[0] - 1.9) : 0), 0.5 * x[1], x[2]};
  });
  const auto built = build(frame);
  EXPECT_GE(built.stiffness->kinds().rectangles, 40);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

/// From another corner, and seen from behind.
TEST(ShellStiffness, NodesListedInOtherOrders) {
  FrameMesh frame = one_plate({6, 5});
  auto& list = frame.mesh().regions[0].connectivity;
  for (std::size_t e = 0; e < list.size(); e += 4) {
    if (e % 3 == 1) std::rotate(&list[e], &list[e + 1], &list[e + 4]);
    if (e % 3 == 2) std::reverse(&list[e], &list[e + 4]);
  }
  const auto built = build(frame);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 30);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ShellStiffness, ParallelogramsByTheirStrains) {
  FrameMesh frame = one_plate({7, 6});
  move_nodes(frame.mesh(), [](Vector3 x) { return Vector3{x[0] + 0.3 * x[1], x[1], x[2]}; });
  const auto built = build(frame);
  EXPECT_EQ(built.stiffness->kinds().general, 42);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 0);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ShellStiffness, AWarpedPartByItsStrains) {
  FrameMesh frame = one_plate({8, 6});
  move_nodes(frame.mesh(), [](Vector3 x) {
    return Vector3{x[0], x[1], x[2] + (x[0] > 2.9 ? 0.003 * std::sin(3 * x[0] * x[1]) : 0)};
  });
  const auto built = build(frame);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 36);
  EXPECT_EQ(built.stiffness->kinds().general, 12);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

/// Beams along the edges of a plate and columns below it, as in a building.
FrameMesh floor_on_columns() {
  FrameMesh frame;
  frame.add_plate({0, 0, 3}, {3, 0, 0}, {0, 2, 0}, {10, 8}, 0.22);
  frame.add_beams({0, 0, 3}, {3, 0, 3}, 10, {0, 0, 1});
  frame.add_beams({0, 2, 3}, {3, 2, 3}, 10, {0, 1, 0});
  frame.add_beams({0, 0, 3}, {0, 2, 3}, 8, {0, 0, 1});
  frame.add_beams({3, 2, 3}, {3, 0, 3}, 8, {0, 0, 1});
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {3.0, 0.0}, {3.0, 2.0}, {0.0, 2.0}}) {
    frame.add_beams({x, y, 0}, {x, y, 3}, 6, {1, 0, 0});
    frame.clamp({x, y, 0});
  }
  return frame;
}

TEST(ShellStiffness, BeamsAttachedToAPlate) {
  FrameMesh frame = floor_on_columns();
  const auto built = build(frame);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 80);
  EXPECT_EQ(built.stiffness->kinds().beams, 36 + 24);
  EXPECT_EQ(built.stiffness->kinds().other, 0);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ShellStiffness, BeamsAttachedToAPlateTurnedInSpace) {
  FrameMesh frame = floor_on_columns();
  move_nodes(frame.mesh(), turned);
  Structure structure = frame.structure();
  for (Region& region : structure.regions) {
    if (region.section) region.section->z_axis = turned(region.section->z_axis);
  }
  const auto built = build_stiffness(frame.mesh(), structure);
  EXPECT_EQ(built.stiffness->kinds().rectangles, 80);
  EXPECT_EQ(built.stiffness->kinds().beams, 60);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

/// Skew beams, sections turned from the frame of the plate, a diagonal with both.
TEST(ShellStiffness, BeamsInFramesOfTheirOwn) {
  FrameMesh frame = floor_on_columns();
  frame.add_beams({0, 0, 3}, {3, 2, 3}, 7, {0, 0, 1});
  frame.add_beams({0, 0, 1}, {3, 2, 2}, 5, {0.3, -0.2, 1});
  frame.add_beams({0, 1, 3}, {3, 1, 3}, 10, {0, 0.5, 1});
  const auto built = build(frame);
  EXPECT_EQ(built.stiffness->kinds().beams, 60 + 22);
  EXPECT_EQ(built.stiffness->kinds().other, 0);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

/// A bar of two translations at nodes of six components.
TEST(ShellStiffness, OtherElementsAtTheSameNodes) {
  FrameMesh frame = floor_on_columns();
  frame.add_beams({0, 0, 0}, {3, 0, 3}, 1, {0, 1, 0});
  frame.mesh().regions.back().type = ElementType::bar;
  Structure structure = frame.structure();
  structure.regions.back().element = ElementType::bar;
  structure.regions.back().area = 1e-3;
  const auto built = build_stiffness(frame.mesh(), structure);
  EXPECT_EQ(built.stiffness->kinds().other, 1);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

/// A receiver of a product of w = u + beta v that changes u and v at once, as a time step does.
class Spoiler final : public stiffness::ForceReceiver {
 public:
  Spoiler(std::vector<double>& u, std::vector<double>& v) : u_(u), v_(v), force(u.size(), NAN) {}
  void receive(LocalIndex begin, LocalIndex end, const double* q) override {
    for (LocalIndex dof = begin; dof < end; ++dof) {
      const auto i = static_cast<std::size_t>(dof);
      EXPECT_TRUE(std::isnan(force[i])) << "dof " << dof << " is handed over twice";
      force[i] = q[dof - begin];
      u_[i] = v_[i] = NAN;
    }
  }

 private:
  std::vector<double>& u_;
  std::vector<double>& v_;

 public:
  std::vector<double> force;
};

TEST(ShellStiffness, HandsEveryDofOverOnce) {
  FrameMesh frame = floor_on_columns();
  const auto built = build(frame);
  constexpr double beta = 0.37;
  const std::size_t n = built.system.lumped_mass.size();
  for (int repeat = 0; repeat < 2; ++repeat) {
    std::vector<double> u = testing_support::random_field(built.mesh, 1);
    std::vector<double> v = testing_support::random_field(built.mesh, 2);
    std::vector<double> w(u);
    std::vector<double> expected(n);
    for (std::size_t i = 0; i < n; ++i) w[i] += beta * v[i];
    Spoiler spoiler(u, v);
    built.stiffness->apply(w.data(), expected.data());
    built.stiffness->apply(stiffness::StiffnessArgument{u.data(), v.data(), beta}, spoiler);
    const double scale = std::accumulate(
        expected.begin(), expected.end(), 0.0,
        [](double largest, double value) { return std::max(largest, std::abs(value)); });
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(spoiler.force[i], expected[i], tolerance * scale) << "dof " << i;
    }
  }
}

TEST(ShellStiffness, IsChosenForShells) {
  FrameMesh frame = floor_on_columns();
  const auto built = testing_support::build_system(frame.mesh(), frame.structure());
  const LinearSystem system =
      pounding::build_system(frame.structure(), built.mesh, StiffnessMethod::automatic);
  EXPECT_EQ(system.stiffness_method,
            "element by element (0 bricks, 80 rectangles, 0 general, 60 beams, 0 others)");
}

TEST(ShellStiffness, IsChosenForIrregularQuadranglesAndFramesAndNotForBars) {
  FrameMesh panel = one_plate({12, 8});
  move_nodes(panel.mesh(), [](Vector3 x) {
    return Vector3{x[0] + 0.02 * std::sin(7 * x[0] * x[1]), x[1] + 0.02 * std::sin(9 * x[0]), x[2]};
  });
  const auto method = [](FrameMesh& frame, const Structure& structure) {
    const auto built = testing_support::build_system(frame.mesh(), structure);
    return pounding::build_system(structure, built.mesh, StiffnessMethod::automatic)
        .stiffness_method;
  };
  EXPECT_EQ(method(panel, panel.structure()),
            "element by element (0 bricks, 0 rectangles, 96 general, 0 beams, 0 others)");
  FrameMesh line;
  line.add_beams({0, 0, 0}, {3, 0, 0}, 7, {0, 0, 1});
  EXPECT_EQ(method(line, line.structure()),
            "element by element (0 bricks, 0 rectangles, 0 general, 7 beams, 0 others)");
  Structure bars = line.structure();
  bars.regions[0].element = line.mesh().regions[0].type = ElementType::bar;
  line.mesh().components.assign(line.mesh().components.size(), 0x7);
  line.mesh().free_components = line.mesh().components;
  EXPECT_EQ(method(line, bars), "assembled");
}

/// Distorted quadrangles and triangles side by side, warped and turned, whose nodes are held in some
/// components.
TEST(ShellStiffness, GeneralShapesWithNodesHeldInPart) {
  FrameMesh frame = one_plate({7, 6});
  frame.add_plate({1, 2, 3}, {2, 0, 0}, {0, 0, 1.5}, {5, 4}, 0.1);
  Structure structure = frame.structure();
  structure.regions.back().element = ElementType::shell3;
  const ElementSet quadrangles = frame.mesh().regions.back();
  ElementSet triangles = quadrangles;
  triangles.type = ElementType::shell3;
  triangles.tags.clear();
  triangles.connectivity.clear();
  for (std::size_t e = 0; e < quadrangles.tags.size(); ++e) {
    const GlobalIndex* const n = &quadrangles.connectivity[4 * e];
    triangles.connectivity.insert(triangles.connectivity.end(),
                                  {n[0], n[1], n[2], n[2], n[3], n[0]});
    for (const int part : {1, 2}) triangles.tags.push_back(1000 + 2 * static_cast<int>(e) + part);
  }
  frame.mesh().regions.back() = triangles;
  move_nodes(frame.mesh(), [](Vector3 x) {
    return turned({x[0] + 0.03 * std::sin(7 * x[1] + x[2]), x[1] + 0.01 * std::sin(9 * x[0]),
                   x[2] + 0.01 * std::sin(20 * x[0] * x[1])});
  });
  auto& free = frame.mesh().free_components;
  for (std::size_t i = 0; i < free.size(); i += 3) free[i] = static_cast<std::uint8_t>(i % 64);
  const auto built = build_stiffness(frame.mesh(), structure);
  EXPECT_EQ(built.stiffness->kinds().general, 42 + 40);
  EXPECT_EQ(built.stiffness->kinds().other, 0);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

}  // namespace shell_stiffness_test
}  // namespace pounding
