#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shell_model.h"

namespace pounding {
namespace shell4_plate_test {

using testing_support::Cells;
using testing_support::ShellModel;

/// Plates of 10 m x 10 m, of the NAFEMS free-vibration set.
constexpr double side = 10;

ShellProperties steel(double thickness, double rotary_inertia_factor = 0) {
  return {200e9, 0.3, 8000, thickness, rotary_inertia_factor};
}

std::vector<double> lowest(const ShellModel& model, std::size_t skipped, std::size_t count) {
  const auto all = model.frequencies();
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(skipped);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

void expect_relative(const std::vector<double>& found, const std::vector<double>& expected,
                     double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i] / expected[i], 1, tolerance) << i;
}

/// Frequencies of a simply supported Mindlin plate (hard support), of m and n half waves [Hz]: with
/// k^2 = pi^2 (m^2 + n^2) / a^2, rotary inertia and shear,
/// (omega^2 rho t - kappa G t k^2)(omega^2 rho t^3 / 12 - D k^2 - kappa G t) = (kappa G t k)^2.
double mindlin(int m, int n, const ShellProperties& p) {
  const double pi = std::numbers::pi;
  const double k2 = pi * pi * (m * m + n * n) / (side * side);
  const double t = p.thickness, shear = 5.0 / 12 * p.young / (1 + p.poisson) * t;
  const double bending = p.young * t * t * t / (12 * (1 - p.poisson * p.poisson));
  const double a = p.density * t, b = p.density * t * t * t / 12;
  const double sum = shear * k2 / a + (bending * k2 + shear) / b;
  const double product = bending * shear * k2 * k2 / (a * b);
  const double omega2 = 2 * product / (sum + std::sqrt(sum * sum - 4 * product));
  return std::sqrt(omega2) / (2 * pi);
}

ShellModel supported_plate(std::size_t n, const ShellProperties& p) {
  auto model = testing_support::square_plate(n, side, p);
  support_hard(model, side);
  return model;
}

TEST(Shell4Plate, AgreesWithAnotherCodeOnTheSameMesh) {
  // An independent code with the same formulation on 8 x 8 elements. Shear is so stiff in a thin
  // plate that the eigenvalues of both codes carry round-off of 1e-7.
  auto cantilever = testing_support::square_plate(8, side, steel(0.05));
  clamp_left(cantilever);
  expect_relative(lowest(cantilever, 0, 6),
                  {0.4165155901815366, 1.0102722890461513, 2.5373511695301763, 3.15517941982734,
                   3.6430241939034693, 6.165034266664804},
                  1e-6);
  expect_relative(lowest(supported_plate(8, steel(0.05)), 0, 6),
                  {2.356537512691327, 5.9382444282702584, 5.9382444282702584, 9.19707172913644,
                   12.309660896291502, 12.309660896291502},
                  1e-6);
  expect_relative(lowest(supported_plate(8, steel(1)), 0, 6),
                  {45.49058504293903, 108.77668171681489, 108.77668171681489, 161.02328035913382,
                   205.9048804599961, 205.90488045999757},
                  1e-6);
}

TEST(Shell4Plate, SimplySupportedPlatesConvergeToMindlinAtSecondOrder) {
  EXPECT_NEAR(mindlin(1, 1, steel(1)), 45.91080191043468, 1e-9);
  EXPECT_NEAR(mindlin(1, 1, steel(0.05)), 2.3765065740818883, 1e-8);
  for (const double thickness : {0.05, 1.0}) {
    const ShellProperties p = steel(thickness);
    const auto coarse = lowest(supported_plate(6, p), 0, 4);
    const auto fine = lowest(supported_plate(12, p), 0, 4);
    for (const std::size_t mode : {0U, 3U}) {
      const double exact = mode == 0 ? mindlin(1, 1, p) : mindlin(2, 2, p);
      const double order = std::log2((coarse[mode] - exact) / (fine[mode] - exact));
      EXPECT_NEAR(order, 2, 0.15) << thickness << ' ' << mode;
    }
  }
}

TEST(Shell4Plate, FreePlateFloatsAndVibrates) {
  const auto f = lowest(testing_support::square_plate(8, side, steel(0.05)), 0, 6);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(f[i], 1e-3);
  // Ritz solution of the Kirchhoff plate; the lumped mesh of 8 x 8 comes from below.
  const double exact[] = {1.6216543574505227, 2.3594962760482074, 2.922282465962102};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(f[3 + i], exact[i]);
    EXPECT_NEAR(f[3 + i] / exact[i], 1, 0.046);
  }
}

TEST(Shell4Plate, TaperedMembraneVibratesInItsPlane) {
  // 10 m long, 5 m to 1 m high, clamped at its high end; Ritz solution in plane stress.
  auto model =
      testing_support::shell_grid(16, 8, steel(0.05), Cells::quadrangles, [](double r, double s) {
        return Vector3{side * r, (s - 0.5) * (5 - 4 * r), 0};
      });
  model.fix_everywhere({2, 3, 4});
  clamp_left(model);
  expect_relative(lowest(model, 0, 6), {44.617, 130.011, 162.689, 245.988, 379.718, 391.406}, 0.01);
}

TEST(Shell4Plate, ScaledRotaryInertiaLowersTheLowestFrequenciesLittle) {
  const auto section = lowest(supported_plate(8, steel(0.05)), 0, 3);
  const auto scaled = lowest(supported_plate(8, steel(0.05, 0.125)), 0, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(scaled[i], section[i]);
    EXPECT_NEAR(scaled[i] / section[i], 1, 0.05);
  }
  // The thick plate has more inertia of its own than the scaling asks on fine meshes.
  expect_relative(lowest(supported_plate(12, steel(1, 0.1)), 0, 3),
                  lowest(supported_plate(12, steel(1)), 0, 3), 1e-14);
}

TEST(Shell4Plate, VeryThinPlateDoesNotLock) {
  // MacNeal and Harder: simply supported 2 x 2, t = 1e-4, pressure 1e-4: 4.06235 at the centre.
  const ShellProperties p{1.7472e7, 0.3, 1, 1e-4, 0};
  auto model = testing_support::square_plate(8, 2, p);
  support_hard(model, 2);
  std::vector<double> load(model.size(), 0.0);
  for (std::size_t i = 2; i < load.size(); i += 6) load[i] = model.lumped_mass()[i];
  const std::size_t centre = 4 * 9 + 4;
  EXPECT_NEAR(model.solve(load)[6 * centre + 2] / 4.062352660673776, 1, 0.006);
}

}  // namespace shell4_plate_test
}  // namespace pounding
