#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shell_model.h"
#include "turned_shell.h"

namespace pounding {
namespace shell3_test {

using testing_support::Cells;
using testing_support::dense_shell;
using testing_support::inner;

const std::vector<double> oblique{0, 0, 0, 1.1, 0.1, 0, 0.4, 0.8, 0};

ShellProperties concrete(double thickness = 0.22) {
  return {30e9, 0.2, 2400, thickness, 0};
}

TEST(Shell3, HasSixRigidModesAndNoOther) {
  for (const double thickness : {0.01, 0.22, 1.0})
    for (const auto& x : {oblique, testing_support::turned(oblique)}) {
      const auto e = dense_shell(x, concrete(thickness));
      testing_support::expect_six_rigid_modes(x, e.stiffness);
      for (std::size_t i = 0; i < 18; ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_EQ(e.stiffness[18 * i + j], e.stiffness[18 * j + i]);
    }
}

TEST(Shell3, TurnsWithItsNodes) {
  testing_support::expect_turns_with_nodes(oblique, concrete());
}

TEST(Shell3, StartsAtAnyCornerInEitherSense) {
  const auto e = dense_shell(oblique, concrete());
  for (const std::array<std::size_t, 3> order :
       {std::array<std::size_t, 3>{1, 2, 0}, {2, 0, 1}, {0, 2, 1}}) {
    std::vector<double> y(9);
    for (std::size_t i = 0; i < 9; ++i) y[i] = oblique[3 * order[i / 3] + i % 3];
    const auto f = dense_shell(y, concrete());
    for (std::size_t i = 0; i < 18; ++i)
      for (std::size_t j = 0; j < 18; ++j)
        EXPECT_NEAR(f.stiffness[18 * i + j],
                    e.stiffness[18 * (6 * order[i / 6] + i % 6) + 6 * order[j / 6] + j % 6],
                    1e-13 * 30e9);
  }
}

TEST(Shell3, ShearAcrossTheThicknessIsSoftenedOnLongEdges) {
  // w = g x without rotation: kappa G t g^2 A / 2 times t^2 / (t^2 + h^2 / 10).
  const double g = 1e-3, area = (1.1 * 0.8 - 0.1 * 0.4) / 2, h2 = 1.1 * 1.1 + 0.1 * 0.1;
  std::vector<double> u(18, 0.0);
  for (std::size_t n = 0; n < 3; ++n) u[6 * n + 2] = g * oblique[3 * n];
  for (const double t : {0.01, 0.22, 100.0}) {
    const auto force = testing_support::multiply(dense_shell(oblique, concrete(t)).stiffness, u);
    const double exact = 0.5 * 5.0 / 6 * 12.5e9 * t * g * g * area * t * t / (t * t + h2 / 10);
    EXPECT_NEAR(0.5 * inner(u, force) / exact, 1, 1e-12);
  }
}

TEST(Shell3, MassIsAThirdOfTheArea) {
  const double t = 0.22, mass = 2400 * t * (1.1 * 0.8 - 0.1 * 0.4) / 6;
  ShellProperties p = concrete(t);
  const auto section = dense_shell(oblique, p).lumped_mass;
  p.rotary_inertia_factor = 0.125;
  const auto scaled = dense_shell(oblique, p).lumped_mass;
  for (std::size_t i = 0; i < 18; ++i) {
    EXPECT_NEAR(section[i], i % 6 < 3 ? mass : mass * t * t / 12, 1e-12);
    EXPECT_NEAR(scaled[i], i % 6 < 3 ? mass : mass * 0.125 * 0.42, 1e-12);
  }
}

TEST(Shell3, WhatItCarriesTurnsAsItsThicknessDoes) {
  ShellProperties p = concrete(0.2);
  const auto bare = dense_shell(oblique, p).lumped_mass;
  p.added_mass = 350;
  const auto loaded = dense_shell(oblique, p).lumped_mass;
  for (std::size_t i = 0; i < 18; ++i) {
    EXPECT_NEAR(loaded[i], bare[i] * (1 + 350 / (p.density * p.thickness)), 1e-12 * loaded[i]);
  }
}

TEST(Shell3, PlatesConvergeToMindlinAtSecondOrder) {
  // Closed forms of the simply supported 10 m square, thin and thick, modes 1 and 4.
  struct Row {
    double thickness, first, fourth;
  };
  for (const Row& row : {Row{0.05, 2.3765065740818883, 9.503431434453596},
                         Row{1, 45.91080191043468, 168.0734738134068}}) {
    std::vector<std::vector<double>> f;
    for (const std::size_t n : {8, 16}) {
      auto model = testing_support::square_plate(n, 10, {200e9, 0.3, 8000, row.thickness, 0},
                                                 Cells::crossed_triangles);
      support_hard(model, 10);
      f.push_back(model.frequencies());
    }
    EXPECT_NEAR(f[1][0] / row.first, 1, 0.003);
    EXPECT_NEAR(f[1][3] / row.fourth, 1, 0.012);
    // Two errors of opposite signs, of mass and of shear, make it look faster on thick plates.
    EXPECT_GT(std::log2((f[0][0] - row.first) / (f[1][0] - row.first)), 1.9);
  }
}

TEST(Shell3, VeryThinPlateDoesNotLock) {
  // MacNeal and Harder: simply supported 2 x 2, t = 1e-4, pressure 1e-4, on one-sided diagonals.
  const double exact = 4.062352660673776;
  std::vector<double> error;
  for (const std::size_t n : {6, 12}) {
    auto model = testing_support::square_plate(n, 2, {1.7472e7, 0.3, 1, 1e-4, 0}, Cells::triangles);
    support_hard(model, 2);
    std::vector<double> load(model.size(), 0.0);
    for (std::size_t i = 2; i < load.size(); i += 6) load[i] = model.lumped_mass()[i];
    const std::size_t centre = n / 2 * (n + 1) + n / 2;
    error.push_back(model.solve(load)[6 * centre + 2] / exact - 1);
  }
  EXPECT_NEAR(error[1], 0, 0.02);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.3);
}

TEST(Shell3, ImpossibleTrianglesAreRefused) {
  const auto refused = [](const std::vector<double>& x, double thickness, const std::string& why) {
    std::vector<double> stiffness(18 * 18), lumped_mass(18);
    for (const bool is_mass : {false, true}) {
      try {
        is_mass ? shell3_lumped_mass(x, concrete(thickness), lumped_mass)
                : shell3_stiffness(x, concrete(thickness), stiffness);
        ADD_FAILURE() << why << " accepted";
      } catch (const ElementError& error) {
        EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      }
    }
  };
  refused({0, 0, 0, 1, 0, 0, 2, 0, 0}, 0.2, "non-positive area");
  refused(std::vector<double>(9, 1.5), 0.2, "non-positive area");
  refused({0, 0, 0, 1, 0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0}, 0.2,
          "non-positive area");
  refused(oblique, 0, "thickness 0 m is not positive");
}

}  // namespace shell3_test
}  // namespace pounding
