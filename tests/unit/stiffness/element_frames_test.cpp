#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "elements/gauss_rule.h"
#include "stiffness/element_shapes.h"

namespace pounding::stiffness {
namespace element_frames_test {

constexpr double tolerance = 1e-10;

/// Corners of a box with edges along turned axes, in Gmsh's order.
std::vector<double> box(const Vector3& origin, const Vector3& lengths, double angle = 0) {
  std::vector<double> x;
  for (const auto& corner : hex_corners) {
    const double u = lengths[0] * (1 + corner[0]) / 2;
    const double v = lengths[1] * (1 + corner[1]) / 2;
    x.push_back(origin[0] + std::cos(angle) * u - std::sin(angle) * v);
    x.push_back(origin[1] + std::sin(angle) * u + std::cos(angle) * v);
    x.push_back(origin[2] + lengths[2] * (1 + corner[2]) / 2);
  }
  return x;
}

/// A rectangle from one corner along two edges, going round.
std::vector<double> rectangle(const Vector3& origin, const Vector3& first, const Vector3& second) {
  std::vector<double> x;
  for (const auto& [s, t] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
    for (std::size_t d = 0; d < 3; ++d) x.push_back(origin[d] + s * first[d] + t * second[d]);
  return x;
}

/// Frames that did not know a shape, and now do.
ElementFrames with_frame_of(const std::vector<double>& shape) {
  ElementFrames frames;
  EXPECT_FALSE(frames.recognise(shape, tolerance));
  const auto axes = ElementFrames::axes_of_box(shape, tolerance);
  EXPECT_TRUE(axes);
  if (axes) frames.add(*axes);
  return frames;
}

void expect_refused(const std::vector<double>& shape) {
  EXPECT_FALSE(ElementFrames().recognise(shape, tolerance));
  EXPECT_FALSE(ElementFrames::axes_of_box(shape, tolerance));
}

TEST(ElementFrames, KnowABoxFarFromTheOrigin) {
  const ElementFrames frames;
  const auto brick = frames.recognise(box({30, -20, 7.1}, {0.3, 0.25, 0.22}), tolerance);
  ASSERT_TRUE(brick);
  EXPECT_EQ(brick->frame, 0);
  EXPECT_NEAR(brick->lengths[1], 0.25, 1e-13);
  EXPECT_EQ(brick->corner, (std::array<int, 8>{0, 1, 3, 2, 4, 5, 7, 6}));
}

TEST(ElementFrames, TurnedBoxesShareAFrame) {
  ElementFrames frames = with_frame_of(box({0, 0, 0}, {1, 2, 3}, 0.4));
  const auto second =
      frames.recognise(box({5, 4, 0}, {2, 2, 1}, 0.4 + std::numbers::pi / 2), tolerance);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->frame, 1);
}

TEST(ElementFrames, RefuseWhatIsNoBox) {
  auto sheared = box({0, 0, 0}, {1, 1, 1});
  for (std::size_t a = 0; a < 8; ++a) sheared[3 * a] += 1e-6 * sheared[3 * a + 1];
  expect_refused(sheared);
  auto tapered = box({0, 0, 0}, {1, 1, 1});
  tapered[3 * 6] += 0.1;
  expect_refused(tapered);
  expect_refused(std::vector<double>(24, 0.0));
}

TEST(ElementFrames, KnowRectanglesInAllThreePlanes) {
  const ElementFrames frames;
  const auto floor = frames.recognise(rectangle({9, 8, 7}, {0.3, 0, 0}, {0, 0.2, 0}), tolerance);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->normal, 2);
  EXPECT_NEAR(floor->lengths[0], 0.3, 1e-13);
  EXPECT_EQ(floor->corner, (std::array<int, 8>{0, 1, 3, 2, -1, -1, -1, -1}));
  const auto wall = frames.recognise(rectangle({0, 0, 0}, {0, 0, 2}, {0, 1, 0}), tolerance);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->normal, 0);
  EXPECT_EQ(wall->lengths, (Vector3{0, 1, 2}));
  EXPECT_EQ(wall->corner, (std::array<int, 8>{0, -1, 3, -1, 1, -1, 2, -1}));
  const auto other = frames.recognise(rectangle({0, 0, 0}, {0, 0, -2}, {3, 0, 0}), tolerance);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->normal, 1);
  EXPECT_EQ(other->lengths, (Vector3{3, 0, 2}));
  EXPECT_EQ(other->corner, (std::array<int, 8>{1, 2, -1, -1, 0, 3, -1, -1}));
}

TEST(ElementFrames, ARectangleLiesInTheFrameOfABox) {
  const ElementFrames frames = with_frame_of(box({0, 0, 0}, {1, 2, 3}, 0.4));
  const double c = std::cos(0.4), s = std::sin(0.4);
  const auto wall = frames.recognise(rectangle({1, 1, 1}, {2 * c, 2 * s, 0}, {0, 0, 1}), tolerance);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->frame, 1);
  EXPECT_EQ(wall->normal, 1);
}

TEST(ElementFrames, RefuseWhatIsNoRectangle) {
  auto skew = rectangle({0, 0, 0}, {1, 0, 0}, {1e-6, 1, 0});
  expect_refused(skew);
  auto warped = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  warped[8] = 1e-6;
  expect_refused(warped);
  auto trapezium = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  trapezium[6] = 0.9;
  expect_refused(trapezium);
}

}  // namespace element_frames_test
}  // namespace pounding::stiffness
