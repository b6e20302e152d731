#include "elements/point.h"

#include <gtest/gtest.h>

#include "elements/element.h"

namespace pounding {
namespace {

TEST(Point, MassOnDisplacementsAndInertiaOnRotations) {
  ElementProperties properties;
  properties.mass = 12;
  properties.rotary_inertia = {1, 2, 3};
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
  ElementProperties properties;
  properties.stiffness = {10, 20, 30, 0, 0, 0};
  properties.dashpot = {1, 2, 3, 0, 0, 0};
  const std::array<double, 6> coordinates{0, 0, 0, 0, 0, 0};  // nodes may coincide
  std::array<double, 36> stiffness{};
  std::array<double, 6> mass{};
  element_matrices(ElementType::spring, coordinates, properties, stiffness, mass);
  std::array<double, 36> damping{};
  element_dashpots(ElementType::spring, properties, damping);
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
  std::array<double, 36> damping{};
  damping.fill(7);
  element_dashpots(ElementType::bar, properties, damping);
  EXPECT_EQ(damping, (std::array<double, 36>{}));
}

}  // namespace
}  // namespace pounding
