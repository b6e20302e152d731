#include "system/rotary_scaling.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "system/mass_scaling.h"
#include "unit/elements/dense_eigen.h"
#include "unit/elements/turned_shell.h"

namespace pounding {
namespace rotary_scaling_test {

using testing_support::dense_shell;
using testing_support::DenseElement;

const std::vector<Rayleigh> dampings{{0, 0}, {2, 0}, {0.5, 1e-5}};

struct Shape {
  std::string name;
  std::vector<double> coordinates;
};

/// Squares, a needle, skew and warped quadrangles, triangles, turned out of the axes as well. [m]
std::vector<Shape> shapes() {
  std::vector<Shape> result{
      {"square", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}},
      {"needle", {0, 0, 0, 1, 0, 0, 1, 0.05, 0, 0, 0.05, 0}},
      {"skew", {0, 0, 0, 1, 0.1, 0, 1.7, 0.9, 0, 0.4, 0.6, 0}},
      {"warped", {0, 0, 0.01, 1, 0, -0.01, 1, 1, 0.01, 0, 1, -0.01}},
      {"triangle", {0, 0, 0, 1, 0, 0, 0.3, 0.8, 0}},
      {"splinter", {0, 0, 0, 1, 0, 0, 0.9, 0.06, 0}},
  };
  const std::size_t flat = result.size();
  for (std::size_t i = 0; i < flat; ++i) {
    result.push_back({"turned " + result[i].name, testing_support::turned(result[i].coordinates)});
  }
  return result;
}

DenseElement shell(const Shape& shape, double thickness) {
  return dense_shell(shape.coordinates, {30e9, 0.2, 2400, thickness});
}

/// The smallest eigenvalue of M^-1 (4 M - 2 dt C - dt^2 K).
double smallest(const DenseElement& element, const std::vector<double>& mass, double dt,
                const Rayleigh& damping) {
  std::vector<double> k = element.stiffness;
  const double square = testing_support::squared_circular_frequencies(k, mass).back();
  return 4 - 2 * dt * (damping.alpha + damping.beta * square) - dt * dt * square;
}

double own_step(const DenseElement& element, const Rayleigh& damping) {
  const double square =
      testing_support::squared_circular_frequencies(element.stiffness, element.lumped_mass).back();
  return critical_time_step(damping.alpha + damping.beta * square, square);
}

std::optional<AddedRadii> radii_for(const Shape& shape, const DenseElement& element, double dt,
                                    const Rayleigh& damping) {
  return needed_radii(dt, damping, 1, shape.coordinates, element.stiffness, element.lumped_mass);
}

TEST(RotaryScaling, GivesShellsOfAnyShapeTheWantedStepOrSaysThatItCannot) {
  int given = 0;
  int refused = 0;
  for (const Shape& shape : shapes()) {
    for (const double thickness : {0.005, 0.05, 0.3, 2.0}) {
      for (const Rayleigh& damping : dampings) {
        const DenseElement element = shell(shape, thickness);
        for (const double times : {1.1, 2.0, 10.0}) {
          const double dt = times * own_step(element, damping);
          const auto radii = radii_for(shape, element, dt, damping);
          refused += radii ? 0 : 1;
          if (!radii) continue;
          ++given;
          std::vector<double> mass = element.lumped_mass;
          add_radii(*radii, shape.coordinates, mass);
          EXPECT_GE(smallest(element, mass, dt, damping), 0) << shape.name << " " << thickness;
          EXPECT_GE(radii->drilling, radii->bending);
          for (std::size_t i = 0; i < mass.size(); ++i) {
            if (i % 6 < 3) {
              EXPECT_EQ(mass[i], element.lumped_mass[i]);
            }
          }
        }
      }
    }
  }
  EXPECT_GT(given, 100);
  EXPECT_GT(refused, 20);
}

TEST(RotaryScaling, IsTheLeastThatDoes) {
  const Rayleigh damping{0.5, 1e-5};
  for (const char* name : {"square", "skew", "triangle"}) {
    for (const Shape& shape : shapes()) {
      if (shape.name != name) continue;
      const DenseElement element = shell(shape, 0.05);
      const double dt = 2 * own_step(element, damping);
      const auto radii = radii_for(shape, element, dt, damping);
      ASSERT_TRUE(radii) << name;
      std::vector<AddedRadii> less{{0.999 * radii->bending, 0.999 * radii->drilling}};
      if (radii->drilling > 1.01 * radii->bending) {
        less.push_back({radii->bending, 0.999 * radii->drilling});
      }
      for (const AddedRadii& given : less) {
        std::vector<double> mass = element.lumped_mass;
        add_radii(given, shape.coordinates, mass);
        EXPECT_LT(smallest(element, mass, dt, damping), 0) << name;
      }
    }
  }
}

TEST(RotaryScaling, AddsNothingWhereTheStepIsAllowedAlready) {
  for (const Shape& shape : shapes()) {
    const DenseElement element = shell(shape, 0.3);
    const auto radii = radii_for(shape, element, 0.5 * own_step(element, {}), {});
    ASSERT_TRUE(radii);
    EXPECT_LE(radii->drilling, shape.name.ends_with("warped") ? 1e-2 : 0) << shape.name;
  }
}

TEST(RotaryScaling, SeesThatNoInertiaHelps) {
  const Shape shape = shapes().front();
  const DenseElement element = shell(shape, 0.3);
  EXPECT_FALSE(radii_for(shape, element, 1e-2, {}));        // its membrane
  EXPECT_FALSE(radii_for(shape, element, 1e-5, {3e5, 0}));  // alpha alone
}

}  // namespace rotary_scaling_test
}  // namespace pounding
