#include "elements/rigid_tank.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pounding {
namespace rigid_tank_test {

using std::numbers::pi;

/// Numbers to four digits, against which finite differences of the potential were held.
struct Published {
  double slenderness, impulsive, first, height, with_floor, first_height, first_with_floor;
};

constexpr Published published[] = {{0.25, 0.2704, 0.6768, 0.4016, 1.6521, 0.5242, 1.9899},
                                   {0.5, 0.5000, 0.4733, 0.4047, 0.8093, 0.5825, 0.8591}};

TEST(RigidTank, HasThePublishedMassesAndHeights) {
  for (const Published& known : published) {
    const TankWater water = water_in_tank(known.slenderness, 1, 9.81, 9);
    EXPECT_NEAR(water.impulsive.mass, known.impulsive, 5e-5);
    EXPECT_NEAR(water.impulsive.height, known.height, 5e-5);
    EXPECT_NEAR(water.impulsive.height_with_floor, known.with_floor, 5e-5);
    EXPECT_NEAR(water.convective[0].mass, known.first, 5e-5);
    EXPECT_NEAR(water.convective[0].height, known.first_height, 5e-5);
    EXPECT_NEAR(water.convective[0].height_with_floor, known.first_with_floor, 5e-5);
  }
}

/// Impulsive mass and height by cosines over the depth, in which nothing of the waves is: sums of
/// many terms and the integral of those left out.
struct Impulsive {
  double mass = 0;
  double moment = 0;
};

Impulsive impulsive_by_cosines(double depth, double length) {
  Impulsive sum;
  constexpr int terms = 2'000'000;
  for (int k = terms - 1; k >= 0; --k) {
    const double b = (k + 0.5) * pi;  // lambda depth
    const double sign = k % 2 == 0 ? 1 : -1;
    const double of_wall = 4 * depth / length * std::tanh(b * length / (2 * depth)) / (b * b);
    sum.mass += of_wall / b;
    sum.moment += of_wall * (1 / b - sign / (b * b));
  }
  return sum;
}

TEST(RigidTank, ImpulsivePartIsThatOfThePotentialWithoutWaves) {
  for (const double slenderness : {0.05, 0.25, 0.5, 1.0, 3.0}) {
    const Impulsive known = impulsive_by_cosines(slenderness, 1);
    const TankWater water = water_in_tank(slenderness, 1, 9.81, 2);
    EXPECT_NEAR(water.impulsive.mass, known.mass, 1e-9) << slenderness;
    EXPECT_NEAR(water.impulsive.height, known.moment / known.mass, 1e-8) << slenderness;
  }
}

TEST(RigidTank, MassAndMomentsAreComplete) {
  for (const double slenderness : {0.1, 0.25, 0.5, 1.0, 2.5}) {
    for (const int modes : {1, 2, 9}) {
      const TankWater water = water_in_tank(slenderness * 3, 3, 9.81, modes);
      double mass = 0, moment = 0, with_floor = 0;
      const auto add = [&](const WaterMass& part) {
        mass += part.mass;
        moment += part.mass * part.height;
        with_floor += part.mass * part.height_with_floor;
      };
      add(water.impulsive);
      for (const WaterMass& mode : water.convective) add(mode);
      ASSERT_EQ(water.convective.size(), modes);
      EXPECT_NEAR(mass, 1, 1e-14);
      EXPECT_NEAR(moment, 0.5, 1e-14);
      EXPECT_NEAR(with_floor, 0.5 + 1 / (12 * slenderness * slenderness), 1e-12);
    }
  }
}

TEST(RigidTank, WavesHaveTheFrequenciesOfAClosedBasin) {
  const TankWater water = water_in_tank(2, 6, 9.81, 3);
  for (int n = 1; n < 6; n += 2) {
    const WaterMass& mode = water.convective[static_cast<std::size_t>(n / 2)];
    const double number = n * pi / 6;
    EXPECT_NEAR(mode.circular_frequency, std::sqrt(9.81 * number * std::tanh(2 * number)), 1e-14);
    // Its force on both walls is that of the pressure density g x wave cosh(k z) / cosh(k depth).
    const double force = 2 * 9.81 * mode.wave * std::tanh(2 * number) / number / (2 * 6);
    const double mass = 8 * std::tanh(2 * number) / (std::pow(n * pi, 3) * 2 / 6);
    EXPECT_NEAR(force, mass * std::pow(mode.circular_frequency, 2), 1e-13);
  }
}

TEST(RigidTank, PressureOnTheWallsIsTheImpulsiveMass) {
  for (const double slenderness : {0.25, 0.5, 2.0}) {
    constexpr int parts = 2000;
    double sum = 0, moment = 0;
    for (int i = 0; i < parts; ++i) {
      const double z = (i + 0.5) / parts;
      const double pressure = impulsive_pressure(z, slenderness * 4, 4);
      sum += pressure / parts;
      moment += z * pressure / parts;
    }
    const TankWater water = water_in_tank(slenderness * 4, 4, 9.81, 1);
    EXPECT_NEAR(2 * sum * slenderness, water.impulsive.mass, 1e-5);
    EXPECT_NEAR(moment / sum, water.impulsive.height, 1e-4);
    EXPECT_NEAR(impulsive_pressure(1, slenderness * 4, 4), 0, 1e-12);
  }
}

}  // namespace rigid_tank_test
}  // namespace pounding
