#include "elements/point.h"

#include <gtest/gtest.h>

#include "elements/element_traits.h"

namespace pounding {
namespace point_test {

TEST(Point, MassOnDisplacementsAndInertiaOnRotations) {
  ElementProperties properties{.mass = 12, .rotary_inertia = {1, 2, 3}};
  std::array<double, 6> mass{};
  point_lumped_mass(properties, mass);
  EXPECT_EQ(mass, (std::array<double, 6>{12, 12, 12, 1, 2, 3}));
  std::array<double, 3> displacements{};
  point_lumped_mass(properties, displacements);
  EXPECT_EQ(displacements, (std::array<double, 3>{12, 12, 12}));
}

TEST(Spring, ToTheGroundIsDiagonal) {
  ElementProperties properties;
  properties.stiffness = {1, 2, 3, 4, 5, 6};
  std::array<double, 36> stiffness{};
  std::array<double, 6> mass{};
  element_matrices(ElementType::grounded_spring6, std::array<double, 3>{7, 8, 9}, properties,
                   stiffness, mass);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_EQ(stiffness[6 * i + j], i == j ? static_cast<double>(i + 1) : 0);
    }
    EXPECT_EQ(mass[i], 0);
  }
}

TEST(Spring, BetweenNodesResistsTheirDifferenceOnly) {
  ElementProperties properties{.stiffness = {10, 20, 30, 0, 0, 0}, .dashpot = {1, 2, 3, 0, 0, 0}};
  const std::array<double, 6> coordinates{0, 0, 0, 0, 0, 0};  // nodes may coincide
  std::array<double, 36> stiffness{};
  std::array<double, 6> mass{};
  element_matrices(ElementType::spring, coordinates, properties, stiffness, mass);
  std::array<double, 36> damping{};
  element_dashpots(ElementType::spring, coordinates, properties, damping);
  const std::array<double, 6> u{1, 1, 1, 1.5, 3, 0};
  const std::array<double, 6> force{-5, -40, 30, 5, 40, -30};
  for (std::size_t i = 0; i < 6; ++i) {
    double spring = 0;
    double dashpot = 0;
    for (std::size_t j = 0; j < 6; ++j) {
      spring += stiffness[6 * i + j] * u[j];
      dashpot += damping[6 * i + j] * u[j];
    }
    EXPECT_DOUBLE_EQ(spring, force[i]);
    EXPECT_DOUBLE_EQ(dashpot, force[i] / 10);
  }
}

TEST(Spring, OtherElementsHaveNoDashpots) {
  ElementProperties properties;
  properties.dashpot = {1, 1, 1, 1, 1, 1};
  std::array<double, 144> damping{};
  damping.fill(7);
  element_dashpots(ElementType::beam, std::array{0., 0., 0., 1., 0., 0.}, properties, damping);
  EXPECT_EQ(damping, (std::array<double, 144>{}));
}

/// A bar's dashpot resists the rate at which its line grows, and nothing across it.
TEST(Bar, DashpotActsAlongItsLine) {
  const ElementProperties properties{.dashpot = {50, 7, 7, 7, 7, 7}};
  std::array<double, 36> damping{};
  element_dashpots(ElementType::bar, std::array{1., 2., 3., 4., 6., 3.}, properties, damping);
  const std::array<double, 3> direction{0.6, 0.8, 0};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const double sign = (i < 3) == (j < 3) ? 1 : -1;
      EXPECT_NEAR(damping[6 * i + j], sign * 50 * direction[i % 3] * direction[j % 3], 1e-14);
    }
  }
}

/// A quarter turn about z takes the end of an arm along x towards y, about x one along y towards z,
/// about y one along z towards x; the other way round with the opposite sign.
TEST(Soil, ArmTurnsWithItsNode) {
  const auto motion = motion_at({2, 3, 5});
  for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(motion[c][c], 1);
  EXPECT_EQ(motion[1][5], 2);   // u_y by a turn about z
  EXPECT_EQ(motion[2][4], -2);  // u_z by one about y
  EXPECT_EQ(motion[2][3], 3);
  EXPECT_EQ(motion[0][5], -3);
  EXPECT_EQ(motion[0][4], 5);
  EXPECT_EQ(motion[1][3], -5);
  for (std::size_t c = 3; c < 6; ++c) {
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(motion[c][i], c == i ? 1 : 0);
  }
}

struct SoilMatrices {
  std::array<double, 36> stiffness{};
  std::array<double, 36> damping{};
  std::array<double, 6> mass{};
};

SoilMatrices soil_matrices(std::span<const GroundSpring> ground) {
  const ElementProperties properties{.ground_springs = ground};
  SoilMatrices found;
  element_matrices(ElementType::soil, std::array{0., 0., 0.}, properties, found.stiffness,
                   found.mass);
  element_dashpots(ElementType::soil, {}, properties, found.damping);
  return found;
}

/// Springs and dashpots of soil are those of the end of the arm: forces on the node that do the
/// same work, for any motion of it.
TEST(Soil, ActsAtTheEndOfItsArm) {
  constexpr std::array stiffnesses{7., 11., 13., 17., 19., 23.};
  const auto motion = motion_at({2, 3, 5});
  std::vector<GroundSpring> ground;
  for (std::size_t c = 0; c < 6; ++c) ground.push_back({motion[c], stiffnesses[c], 1. + double(c)});
  const auto [stiffness, damping, mass] = soil_matrices(ground);
  EXPECT_EQ(mass, (std::array<double, 6>{}));
  const std::array node{0.5, -1., 2., 0.25, 3., -4.};
  const std::array end{
      0.5 + 3 * 5 + 4 * 3, -1 - 4 * 2 - 0.25 * 5, 2 + 0.25 * 3 - 3 * 2, 0.25, 3., -4.};
  const auto work = [&](const std::array<double, 36>& matrix) {
    double sum = 0;
    for (std::size_t i = 0; i < 36; ++i) {
      EXPECT_EQ(matrix[i], matrix[6 * (i % 6) + i / 6]);
      sum += node[i / 6] * matrix[i] * node[i % 6];
    }
    return sum;
  };
  double springs = 0;
  double dashpots = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    springs += ground[c].stiffness * end[c] * end[c];
    dashpots += ground[c].dashpot * end[c] * end[c];
  }
  EXPECT_NEAR(work(stiffness), springs, 1e-12 * springs);
  EXPECT_NEAR(work(damping), dashpots, 1e-12 * dashpots);
}

/// A motion that is a mixture of several couples them, and the matrix is symmetric to the last bit.
TEST(Soil, MixedMotionsAreCoupled) {
  const std::array<GroundSpring, 1> ground{{{{0.3, -0.7, 0, 1.1, 0.9, 0}, 7, 5}}};
  const auto [stiffness, damping, mass] = soil_matrices(ground);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const double product = ground[0].motion[i] * ground[0].motion[j];
      EXPECT_DOUBLE_EQ(stiffness[6 * i + j], 7 * product);
      EXPECT_DOUBLE_EQ(damping[6 * i + j], 5 * product);
      EXPECT_EQ(stiffness[6 * i + j], stiffness[6 * j + i]);
    }
  }
}

}  // namespace point_test
}  // namespace pounding
