#include "system/brick_class.h"

#include <cmath>

#include <gtest/gtest.h>

#include "elements/gauss_rule.h"

namespace pounding {
namespace {

using Coordinates = std::array<double, 24>;

/// Box with edges along turned axes, nodes in Gmsh's order.
Coordinates box(const Vector3& origin, const Vector3& lengths, double angle = 0) {
  Coordinates x{};
  for (std::size_t a = 0; a < 8; ++a) {
    const double u = lengths[0] * (1 + hex_corners[a][0]) / 2;
    const double v = lengths[1] * (1 + hex_corners[a][1]) / 2;
    x[3 * a] = origin[0] + std::cos(angle) * u - std::sin(angle) * v;
    x[3 * a + 1] = origin[1] + std::sin(angle) * u + std::cos(angle) * v;
    x[3 * a + 2] = origin[2] + lengths[2] * (1 + hex_corners[a][2]) / 2;
  }
  return x;
}

ElementProperties concrete() {
  ElementProperties properties;
  properties.young = 30e9;
  properties.poisson = 0.2;
  properties.density = 2400;
  return properties;
}

TEST(BrickFrames, KnowsABoxFarFromTheOrigin) {
  BrickFrames frames;
  const auto brick = frames.recognise(box({30, -20, 7.1}, {0.3, 0.25, 0.22}), 1e-10);
  ASSERT_TRUE(brick);
  EXPECT_EQ(brick->frame, 0);
  EXPECT_NEAR(brick->lengths[1], 0.25, 1e-13);
  EXPECT_EQ(brick->corner, (std::array<int, 8>{0, 1, 3, 2, 4, 5, 7, 6}));
}

TEST(BrickFrames, TurnedBoxesShareAFrame) {
  BrickFrames frames;
  EXPECT_FALSE(frames.recognise(box({0, 0, 0}, {1, 2, 3}, 0.4), 1e-10));
  const auto axes = BrickFrames::axes_of_box(box({0, 0, 0}, {1, 2, 3}, 0.4), 1e-10);
  ASSERT_TRUE(axes);
  frames.add(*axes);
  const auto second =
      frames.recognise(box({5, 4, 0}, {2, 2, 1}, 0.4 + 3.14159265358979323846 / 2), 1e-10);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->frame, 1);
}

TEST(BrickFrames, RefusesWhatIsNoBox) {
  BrickFrames frames;
  Coordinates sheared = box({0, 0, 0}, {1, 1, 1});
  for (std::size_t a = 0; a < 8; ++a) sheared[3 * a] += 1e-6 * sheared[3 * a + 1];
  EXPECT_FALSE(frames.recognise(sheared, 1e-10));
  EXPECT_FALSE(BrickFrames::axes_of_box(sheared, 1e-10));
  Coordinates tapered = box({0, 0, 0}, {1, 1, 1});
  tapered[3 * 6] += 0.1;
  EXPECT_FALSE(BrickFrames::axes_of_box(tapered, 1e-10));
  EXPECT_FALSE(frames.recognise(Coordinates{}, 1e-10));
  EXPECT_FALSE(BrickFrames::axes_of_box(Coordinates{}, 1e-10));
}

/// A box pulled along one axis: dilation is the constrained modulus, and a shear is G.
TEST(BrickSplit, ConstantStrainsHaveTheModuliOfElasticity) {
  const Vector3 lengths{0.5, 0.25, 0.2};
  const double volume = 0.5 * 0.25 * 0.2;
  const double shear_modulus = 30e9 / 2.4;
  const double lame = 30e9 * 0.2 / (1.2 * 0.6);
  const auto split = split_brick(ElementType::hex8, concrete(), lengths);
  ASSERT_TRUE(split);
  // u = x e gives H u = 4 l e: energy B (4 l e)^2 = (lame + 2 G) e^2 V.
  EXPECT_NEAR(split->dilation[0] * 16 * 0.25 / ((lame + 2 * shear_modulus) * volume), 1, 1e-12);
  EXPECT_NEAR(split->dilation[1] * 16 * 0.5 * 0.25 / (lame * volume), 1, 1e-12);
  EXPECT_NEAR(split->shear[0][0] * 16 * 0.0625 / (shear_modulus * volume), 1, 1e-12);
  EXPECT_NEAR(split->shear[0][1] * 16 * 0.125 / (shear_modulus * volume), 1, 1e-12);
}

}  // namespace
}  // namespace pounding
