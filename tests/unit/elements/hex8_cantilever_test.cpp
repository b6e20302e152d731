#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "brick_mesh.h"

namespace pounding {
namespace hex8_cantilever_test {

using testing_support::brick_cantilever;
using testing_support::BrickCantilever;

/// MacNeal and Harder's straight cantilever, 6 x 0.2 x 0.1 in six bricks, whose inner faces are
/// tilted by `bottom` and `top` metres at y = 0 and y = 0.2, alternating when `alternate`.
struct MeshShape {
  const char* name;
  double tilt;
  bool alternate;
};

/// Mean tip displacement under a unit load shared by the four tip nodes.
double tip_displacement(ElementType type, const MeshShape& shape, std::size_t direction) {
  ElementProperties p{.young = 1e7, .poisson = 0.3, .density = 1};
  const auto place = [&](std::array<std::size_t, 3> at, Vector3 x) {
    if (at[0] == 0 || at[0] == 6) return x;
    const double side = at[1] == 0 ? -1 : 1;
    const double sign = shape.alternate && at[0] % 2 == 0 ? -1 : 1;
    x[0] += side * sign * shape.tilt;
    return x;
  };
  const BrickCantilever beam = brick_cantilever(type, {6, 1, 1}, {6, 0.2, 0.1}, p, place);
  std::vector<double> load(beam.model.size(), 0.0);
  for (const std::size_t node : beam.tip) load[beam.model.dof(node, direction)] = 0.25;
  const auto u = beam.model.solve(load);
  double mean = 0;
  for (const std::size_t node : beam.tip) mean += 0.25 * u[beam.model.dof(node, direction)];
  return mean;
}

TEST(Hex8Cantilever, MacNealHarderTipDisplacements) {
  struct Row {
    MeshShape shape;
    double full[3];
    double incompatible[3];
  };
  const Row rows[] = {
      {{"rectangle", 0, false},
       {2.956829886591887e-05, 0.010043250964064908, 0.010881798601587498},
       {2.9628846357194203e-05, 0.10574410288201389, 0.42036852642261247}},
      {{"trapezoid", 0.1, true},
       {2.9575806512071043e-05, 0.002763857374406493, 0.004515510693431083},
       {2.9829793652304387e-05, 0.00511780727296705, 0.013036994319279361}},
      {{"parallelogram", 0.1, false},
       {2.957473468875168e-05, 0.0034096194558202973, 0.006154099368017621},
       {2.9827314590656677e-05, 0.06741602924874585, 0.22827973624883566}},
  };
  for (const Row& row : rows)
    for (std::size_t d = 0; d < 3; ++d) {
      const double full = tip_displacement(ElementType::hex8_full, row.shape, d);
      const double incompatible = tip_displacement(ElementType::hex8, row.shape, d);
      EXPECT_NEAR(full / row.full[d], 1, 1e-8) << row.shape.name << ' ' << d;
      EXPECT_NEAR(incompatible / row.incompatible[d], 1, 1e-8) << row.shape.name << ' ' << d;
    }
}

TEST(Hex8Cantilever, RectangularBricksNearlyReachBeamTheory) {
  const MeshShape rectangle{"rectangle", 0, false};
  // Shear included; six linear elements miss by 2.2 to 2.8 % where full integration locks at 0.1.
  EXPECT_NEAR(tip_displacement(ElementType::hex8, rectangle, 1) / 0.1081, 1, 0.03);
  EXPECT_NEAR(tip_displacement(ElementType::hex8, rectangle, 2) / 0.4321, 1, 0.03);
}

TEST(Hex8Cantilever, ConcreteCantileverFrequencies) {
  ElementProperties p{.young = 30e9, .poisson = 0.2, .density = 2400};
  struct Row {
    std::array<std::size_t, 3> n;
    ElementType type;
    double frequencies[8];
  };
  const Row rows[] = {
      {{10, 1, 1},
       ElementType::hex8_full,
       {10.1681, 13.6587, 58.6266, 61.6438, 79.937, 165.4385, 174.7388, 177.18}},
      {{10, 1, 1},
       ElementType::hex8,
       {6.8337, 11.3047, 41.9083, 58.6266, 66.8853, 114.4266, 174.1204, 174.7388}},
      {{20, 2, 2},
       ElementType::hex8_full,
       {7.8346, 11.9997, 48.1808, 71.8609, 82.7497, 131.3368, 177.0702, 189.1039}},
      {{20, 2, 2},
       ElementType::hex8,
       {6.8532, 11.3599, 42.2707, 68.2261, 82.678, 115.7399, 177.0337, 180.1856}},
  };
  for (const Row& row : rows) {
    const auto f = brick_cantilever(row.type, row.n, {5, 0.5, 0.3}, p).model.frequencies();
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_NEAR(f[i], row.frequencies[i], 1e-4) << row.n[0] << " elements, mode " << i + 1;
  }
}

}  // namespace hex8_cantilever_test
}  // namespace pounding
