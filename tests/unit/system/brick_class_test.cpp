#include "system/brick_class.h"

#include <cmath>

#include <gtest/gtest.h>

#include "elements/gauss_rule.h"
#include "system/brick_kernel.h"

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
  const auto first = frames.recognise(box({0, 0, 0}, {1, 2, 3}, 0.4), 1e-10);
  const auto second =
      frames.recognise(box({5, 4, 0}, {2, 2, 1}, 0.4 + 3.14159265358979323846 / 2), 1e-10);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->frame, 1);
  EXPECT_EQ(second->frame, 1);
}

TEST(BrickFrames, RefusesWhatIsNoBox) {
  BrickFrames frames;
  Coordinates sheared = box({0, 0, 0}, {1, 1, 1});
  for (std::size_t a = 0; a < 8; ++a) sheared[3 * a] += 1e-6 * sheared[3 * a + 1];
  EXPECT_FALSE(frames.recognise(sheared, 1e-10));
  Coordinates tapered = box({0, 0, 0}, {1, 1, 1});
  tapered[3 * 6] += 0.1;
  EXPECT_FALSE(frames.recognise(tapered, 1e-10));
  EXPECT_FALSE(frames.recognise(Coordinates{}, 1e-10));
}

/// A box pulled along one axis: dilation is the constrained modulus, and a shear is G.
TEST(BrickSplit, ConstantStrainsHaveTheModuliOfElasticity) {
  const Vector3 lengths{0.5, 0.25, 0.2};
  const double volume = 0.5 * 0.25 * 0.2;
  const double shear_modulus = 30e9 / 2.4;
  const double lame = 30e9 * 0.2 / (1.2 * 0.6);
  const auto split = split_brick(ElementType::hex8, concrete(), lengths, 0);
  ASSERT_TRUE(split);
  // u = x e gives H u = 4 l e: energy B (4 l e)^2 = (lame + 2 G) e^2 V.
  EXPECT_NEAR(split->dilation[0] * 16 * 0.25 / ((lame + 2 * shear_modulus) * volume), 1, 1e-12);
  EXPECT_NEAR(split->dilation[1] * 16 * 0.5 * 0.25 / (lame * volume), 1, 1e-12);
  EXPECT_NEAR(split->shear[0][0] * 16 * 0.0625 / (shear_modulus * volume), 1, 1e-12);
  EXPECT_NEAR(split->shear[0][1] * 16 * 0.125 / (shear_modulus * volume), 1, 1e-12);
}

/// Products of single bricks, all axes and formulations, slender ones too, against the dense
/// matrix.
TEST(BrickSplit, IsTheElementMatrix) {
  for (const ElementType type : {ElementType::hex8, ElementType::hex8_full}) {
    for (const Vector3& lengths :
         {Vector3{1, 1, 1}, Vector3{0.31, 0.27, 0.22}, Vector3{2, 1, 0.1}}) {
      std::array<double, 576> stiffness{};
      std::array<double, 24> mass{};
      element_matrices(type, box({0, 0, 0}, lengths), concrete(), stiffness, mass);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto split = split_brick(type, concrete(), lengths, static_cast<int>(axis));
        ASSERT_TRUE(split);
        constexpr int stride = 8;
        std::array<double, 4 * 6 * stride> memory{};
        std::array<BrickLine, 4> lines;
        for (std::size_t l = 0; l < 4; ++l) {
          lines[l] = {&memory[l * 6 * stride], &memory[(l * 6 + 3) * stride]};
        }
        // Where node a, component c of the dense matrix stands in the lines.
        const auto place = [&](std::size_t a, std::size_t c) {
          const auto far = [&](std::size_t d) {
            return hex_corners[a][(axis + d) % 3] > 0 ? 1u : 0u;
          };
          return (far(1) + 2 * far(2)) * 6 * stride + (c + 3 - axis) % 3 * stride + far(0);
        };
        std::array<double, 24> w{};
        for (std::size_t i = 0; i < 24; ++i) {
          w[i] = std::sin(3.0 + 7.0 * static_cast<double>(i * i));
          memory[place(i / 3, i % 3)] = w[i];
        }
        add_brick_run(*split, lines, stride, 1);
        for (std::size_t i = 0; i < 24; ++i) {
          double expected = 0;
          for (std::size_t j = 0; j < 24; ++j) expected += stiffness[24 * i + j] * w[j];
          EXPECT_NEAR(memory[3 * stride + place(i / 3, i % 3)], expected, 1e-13 * stiffness[0] * 24)
              << "axis " << axis << ", dof " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace pounding
