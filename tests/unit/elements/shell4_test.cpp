#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "shell_model.h"
#include "turned_shell.h"

namespace pounding {
namespace shell4_test {

using testing_support::dense_shell;
using testing_support::inner;
using testing_support::squared_circular_frequencies;
using testing_support::symmetric_eigenvalues;

const std::vector<double> distorted{0, 0, 0, 1.1, 0.1, 0, 0.9, 0.8, 0, -0.1, 0.6, 0};
const std::vector<double> warped{0, 0, .03, 1.1, .1, -.03, .9, .8, .03, -.1, .6, -.03};

ShellProperties concrete(double thickness = 0.22, double rotary_inertia_factor = 0) {
  return {30e9, 0.2, 2400, thickness, rotary_inertia_factor};
}

std::vector<double> square(double h) {
  return {0, 0, 0, h, 0, 0, h, h, 0, 0, h, 0};
}

TEST(Shell4, HasSixRigidModesAndNoOther) {
  for (const double thickness : {0.01, 0.22, 1.0})
    for (const auto& x : {square(1), distorted, warped, testing_support::turned(warped)}) {
      const auto e = dense_shell(x, concrete(thickness));
      testing_support::expect_six_rigid_modes(x, e.stiffness);
      for (std::size_t i = 0; i < 24; ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_EQ(e.stiffness[24 * i + j], e.stiffness[24 * j + i]);
    }
}

TEST(Shell4, TurnsWithItsNodes) {
  for (const auto& x : {distorted, warped}) testing_support::expect_turns_with_nodes(x, concrete());
}

TEST(Shell4, StartsAtAnyCornerInEitherSense) {
  for (const std::array<std::size_t, 4> order :
       {std::array<std::size_t, 4>{1, 2, 3, 0}, {2, 3, 0, 1}, {3, 2, 1, 0}}) {
    const auto e = dense_shell(warped, concrete());
    std::vector<double> y(12);
    for (std::size_t i = 0; i < 12; ++i) y[i] = warped[3 * order[i / 3] + i % 3];
    const auto f = dense_shell(y, concrete());
    for (std::size_t i = 0; i < 24; ++i) {
      const std::size_t row = 6 * order[i / 6] + i % 6;
      EXPECT_NEAR(f.lumped_mass[i], e.lumped_mass[row], 1e-12 * e.lumped_mass[0]);
      for (std::size_t j = 0; j < 24; ++j)
        EXPECT_NEAR(f.stiffness[24 * i + j], e.stiffness[24 * row + 6 * order[j / 6] + j % 6],
                    1e-13 * 30e9);
    }
  }
}

TEST(Shell4, KeepsItsDigitsFarFromTheOrigin) {
  auto far = distorted;
  for (double& x : far) x += 1048576;
  for (std::size_t i = 0; i < far.size(); ++i) far[i] = std::round(far[i] * 4096) / 4096;
  auto near = far;
  for (double& x : near) x -= 1048576;
  EXPECT_EQ(dense_shell(far, concrete()).stiffness, dense_shell(near, concrete()).stiffness);
}

TEST(Shell4, SquareDilatationHasItsClosedForm) {
  // omega = (2 / h) sqrt(E / ((1 - nu) rho)), the largest of a thick element.
  const ShellProperties p = concrete();
  const auto e = dense_shell(square(0.12), p);
  const double omega = std::sqrt(squared_circular_frequencies(e.stiffness, e.lumped_mass).back());
  EXPECT_NEAR(omega / (2 / 0.12 * std::sqrt(30e9 / (0.8 * 2400))), 1, 1e-12);
  EXPECT_NEAR(omega / 65880.78458684127, 1, 1e-12);
}

/// Does the spectrum hold `value`?
bool holds(const std::vector<double>& values, double value) {
  return std::any_of(values.begin(), values.end(),
                     [&](double v) { return std::abs(v / value - 1) < 1e-9; });
}

TEST(Shell4, ThinElementIsGovernedByItsShearCutOff) {
  // Uniform shear: the fibres turn against the nodes, which follow at h / 2 from the middle:
  // omega^2 = kappa G / rho (12 / t^2 + 4 / h^2); drilling alike: G / rho (12 / t^2 + 2 / h^2).
  const double h = 0.1, t = 0.01, g = 210e9 / 2.6;
  const ShellProperties p{210e9, 0.3, 7800, t, 0};
  const auto e = dense_shell(square(h), p);
  const auto values = squared_circular_frequencies(e.stiffness, e.lumped_mass);
  const double cut_off = std::sqrt(10 * g / 7800) / t;
  const double shear = 5.0 / 6 * g / 7800 * (12 / (t * t) + 4 / (h * h));
  EXPECT_TRUE(holds(values, shear));
  EXPECT_NEAR(std::sqrt(shear) / cut_off, 1, 2e-3);
  EXPECT_NEAR(std::sqrt(shear) / 1019291.2415538952, 1, 1e-12);
  const double drilling = g / 7800 * (12 / (t * t) + 2 / (h * h));
  EXPECT_NEAR(values.back() / drilling, 1, 1e-9);
  ShellProperties softer = p;
  softer.drilling_factor = 0.5;  // the shear cut-off is the largest then
  const auto half = dense_shell(square(h), softer);
  EXPECT_NEAR(squared_circular_frequencies(half.stiffness, half.lumped_mass).back() / shear, 1,
              1e-9);
}

TEST(Shell4, ScaledRotaryInertiaLeavesTheMembraneInCharge) {
  for (const double t : {0.01, 0.001}) {
    const ShellProperties p{210e9, 0.3, 7800, t, 1.0 / 8};
    const auto e = dense_shell(square(0.1), p);
    const auto values = squared_circular_frequencies(e.stiffness, e.lumped_mass);
    EXPECT_NEAR(std::sqrt(values.back()) / 124034.73458920846, 1, 1e-9);
  }
}

TEST(Shell4, MassIsTheShareOfArea) {
  // A trapezium of sides 2 and 1 and height 1: at height y the width is 2 - y, of which each upper
  // node takes y / 2: the integral of y (2 - y) / 2 is 1/3, and 5/12 remain for each lower one.
  const double t = 0.2;
  const auto e = dense_shell({-1, 0, 0, 1, 0, 0, .5, 1, 0, -.5, 1, 0}, concrete(t));
  for (std::size_t node = 0; node < 4; ++node)
    for (std::size_t i = 0; i < 3; ++i) {
      const double mass = 2400 * t * (node < 2 ? 5.0 / 12 : 1.0 / 3);
      EXPECT_NEAR(e.lumped_mass[6 * node + i], mass, 1e-11);
      EXPECT_NEAR(e.lumped_mass[6 * node + 3 + i], mass * t * t / 12, 1e-12);
    }
}

TEST(Shell4, RotaryInertiaIsTheLargerOfSectionAndScaling) {
  const auto rotary = [](double thickness, double factor) {
    return dense_shell(square(1), concrete(thickness, factor)).lumped_mass[5] /
           (2400 * thickness / 4);
  };
  EXPECT_NEAR(rotary(0.1, 0), 0.01 / 12, 1e-15);
  EXPECT_NEAR(rotary(0.1, 0.125), 0.125, 1e-15);
  EXPECT_NEAR(rotary(2, 0.125), 4.0 / 12, 1e-15);
}

TEST(Shell4, BendsExactlyInItsPlane) {
  // u = k x y, v parabolic within the element, the drilling rotation -k x: energy E k^2 I a / 2.
  const double a = 0.5, b = 0.3, t = 0.1, k = 1e-3;
  for (const double poisson : {0.0, 0.3}) {
    const ShellProperties p{30e9, poisson, 2400, t, 0};
    const std::vector<double> x{-a / 2, -b / 2, 0, a / 2,  -b / 2, 0,
                                a / 2,  b / 2,  0, -a / 2, b / 2,  0};
    std::vector<double> u(24, 0.0);
    for (std::size_t n = 0; n < 4; ++n) {
      u[6 * n] = k * x[3 * n] * x[3 * n + 1];
      u[6 * n + 5] = -k * x[3 * n];
    }
    const auto force = testing_support::multiply(dense_shell(x, p).stiffness, u);
    EXPECT_NEAR(0.5 * inner(u, force) / (0.5 * 30e9 * k * k * t * b * b * b / 12 * a), 1, 1e-12);
  }
}

TEST(Shell4, ResistsShearAcrossItsThickness) {
  // w = g x without rotation: energy kappa G t g^2 A / 2 on any shape.
  const double g = 1e-3;
  std::vector<double> u(24, 0.0);
  for (std::size_t n = 0; n < 4; ++n) u[6 * n + 2] = g * distorted[3 * n];
  const auto force = testing_support::multiply(dense_shell(distorted, concrete()).stiffness, u);
  const double area = ((0.9 - 0) * (0.6 - 0.1) - (0.8 - 0) * (-0.1 - 1.1)) / 2;
  EXPECT_NEAR(0.5 * inner(u, force) / (0.5 * 5.0 / 6 * 12.5e9 * 0.22 * g * g * area), 1, 1e-12);
}

}  // namespace shell4_test
}  // namespace pounding
