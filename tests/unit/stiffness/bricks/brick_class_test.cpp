#include <cmath>

#include <gtest/gtest.h>

#include "elements/gauss_rule.h"
#include "stiffness/bricks/brick_stencil.h"

namespace pounding::stiffness {
namespace brick_class_test {

ElementProperties concrete() {
  return {.young = 30e9, .poisson = 0.2, .density = 2400};
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

}  // namespace brick_class_test
}  // namespace pounding::stiffness
