#include "soil/impedance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "soil/foundation.h"
#include "soil/rectangle.h"

namespace pounding {
namespace impedance_test {

constexpr HalfSpace third{300, 2000, 1.0 / 3};

/// Impedance over the static stiffness at some a0, and its imaginary part over a0 as well.
std::complex<double> over_static(const Impedance& mode, double a0, double length,
                                 const HalfSpace& soil) {
  const std::complex<double> value = mode.at(a0 * soil.shear_velocity / length) / mode.stiffness;
  return {value.real(), value.imag() / a0};
}

TEST(Rectangle, SquareHasThePublishedStaticStiffness) {
  constexpr double half = 7;
  const double unit = third.shear_modulus() * half;
  const Impedances square = rectangle_impedances(third, {2 * half, 2 * half}, 0);
  const std::array expected{5.52, 5.52, 7.05, 6.00, 6.00, 8.31};
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(square[c].stiffness / (unit * (c < 3 ? 1 : half * half)), expected[c], 5e-3) << c;
  }
}

TEST(Rectangle, LongSideTakesItsFormulasWithIt) {
  const Impedances along_x = rectangle_impedances(third, {30, 12}, 3);
  const Impedances along_y = rectangle_impedances(third, {12, 30}, 3);
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 0}, {2, 2}, {3, 4}, {4, 3}, {5, 5}}) {
    EXPECT_EQ(along_x[a].stiffness, along_y[b].stiffness);
    EXPECT_EQ(along_x[a].inner_mass, along_y[b].inner_mass);
    EXPECT_EQ(along_x[a].dashpot, along_y[b].dashpot);
  }
  EXPECT_GT(along_x[4].stiffness, along_x[3].stiffness);  // it rocks least over its long side
  EXPECT_GT(along_x[1].stiffness, along_x[0].stiffness);
}

/// D = B = L / 2: 1 + .375, 1 + .33 + 1.34 / 3, 1 + 1 + 1.6 / 2.35, 1 + 1 + 1.6 / 16.35, 1 + 1.96.
TEST(Rectangle, EmbedmentStiffensByThePublishedFactors) {
  const Impedances surface = rectangle_impedances(third, {20, 10}, 0);
  const Impedances deep = rectangle_impedances(third, {20, 10}, 5);
  const std::array expected{1.7766666666666666, 1.7766666666666666, 1.375,
                            2.6808510638297873, 2.0978593272171254, 2.96};
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(deep[c].stiffness / surface[c].stiffness, expected[c], 1e-12) << c;
  }
}

TEST(Rectangle, RealPartIsThePublishedOne) {
  constexpr double half = 6;
  for (const double r : {1.0, 1.5, 2.0, 4.0}) {
    const Impedances modes = rectangle_impedances(third, {2 * half * r, 2 * half}, 2);
    for (const double a0 : {0.1, 0.5, 1.0, 1.7, 2.0}) {
      const double x = a0 * a0;
      const double root = std::sqrt(r - 1);
      const double cube = r * r * r;
      const std::array expected{1.0,
                                1.0,
                                1 - (0.4 + 0.2 / r) * x / (10 / (1 + 3 * (r - 1)) + x),
                                1 - (0.55 + 0.01 * root) * x / (2.4 - 0.4 / cube + x),
                                1 - 0.55 * x / (0.6 + 1.4 / cube + x),
                                1 - (0.33 - 0.03 * root) * x / (0.8 / (1 + 0.33 * (r - 1)) + x)};
      for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(over_static(modes[c], a0, half, third).real(), expected[c], 1e-14)
            << c << " " << r << " " << a0;
      }
    }
  }
}

/// Imaginary parts over the published ones, the smallest and the largest for a0 from 0.1 to 2.
struct Radiation {
  std::array<double, 6> lowest;
  std::array<double, 6> highest;
};

Radiation radiation(double r) {
  constexpr double half = 6;
  constexpr double psi = 2;  // V_p / V_s of nu = 1/3
  const double cube = r * r * r;
  const double unit = third.shear_modulus() * half;
  const Impedances modes = rectangle_impedances(third, {2 * half * r, 2 * half}, 0);
  Radiation found;
  found.lowest.fill(10);
  found.highest.fill(0);
  for (int i = 2; i <= 40; ++i) {
    const double a0 = 0.05 * i;
    const double x = a0 * a0;
    const std::array published{
        4 * r,
        4 * r,
        4 * psi * r,
        4 * psi / 3 * r * x / (2.2 - 0.4 / cube + x),
        4 * psi / 3 * cube * x / (1.8 / (1 + 1.75 * (r - 1)) + x),
        4.0 / 3 * (cube + r) * x / (1.4 / (1 + 3 * std::pow(r - 1, 0.7)) + x)};
    for (std::size_t c = 0; c < 6; ++c) {
      const double scale = unit * (c < 3 ? 1 : half * half) / modes[c].stiffness;
      const double ratio = over_static(modes[c], a0, half, third).imag() / (published[c] * scale);
      found.lowest[c] = std::min(found.lowest[c], ratio);
      found.highest[c] = std::max(found.highest[c], ratio);
    }
  }
  return found;
}

/// Parts of the published radiation that one internal mass has, as docs/reference/theory/links.md states them.
TEST(Rectangle, ImaginaryPartBesideThePublishedRadiation) {
  const auto expect = [](double r, const std::array<double, 6>& low,
                         const std::array<double, 6>& high) {
    const Radiation found = radiation(r);
    for (std::size_t c = 0; c < 6; ++c) {
      EXPECT_NEAR(found.lowest[c], low[c], 1e-3) << r << " " << c;
      EXPECT_NEAR(found.highest[c], high[c], 1e-3) << r << " " << c;
    }
  };
  expect(1, {1, 1, 0.952, 0.788, 0.788, 1.293}, {1, 1, 1, 0.846, 0.846, 2.001});
  expect(2, {1, 1, 0.876, 0.677, 0.742, 0.466}, {1, 1, 1, 0.716, 0.855, 0.748});
  expect(4, {1, 1, 0.827, 0.643, 0.301, 0.303}, {1, 1, 1, 0.679, 0.592, 0.602});
}

TEST(Disk, HasThePublishedStaticStiffness) {
  for (const double nu : {0.0, 0.2, 1.0 / 3, 0.45}) {
    const HalfSpace soil{200, 1800, nu};
    const Impedances disk = disk_impedances(soil, 9);
    const double unit = soil.shear_modulus() * 9;
    EXPECT_NEAR(disk[0].stiffness / unit, 8 / (2 - nu), 1e-12);
    EXPECT_NEAR(disk[2].stiffness / unit, 4 / (1 - nu), 1e-12);
    EXPECT_NEAR(disk[3].stiffness / (81 * unit), 8 / (3 * (1 - nu)), 1e-12);
    EXPECT_NEAR(disk[5].stiffness / (81 * unit), 16.0 / 3, 1e-12);
  }
}

/// Numbers of the published formulas at a0 = 1 and 2, to four digits.
TEST(Disk, IsThatOfVeletsosAndVerbicAtOneThird) {
  const Impedances disk = disk_impedances(third, 11);
  const auto expect = [&](const Impedance& mode, double a0, double k, double c) {
    const std::complex<double> found = over_static(mode, a0, 11, third);
    EXPECT_NEAR(found.real(), k, 5e-5) << a0;
    EXPECT_NEAR(found.imag(), c, 5e-5) << a0;
  };
  expect(disk[0], 1, 1, 0.65);
  expect(disk[3], 1, 0.8400, 0.0800);
  expect(disk[4], 2, 0.6000, 0.2000);
  expect(disk[2], 1, 0.8634, 0.8593);
  expect(disk[2], 2, 0.7483, 0.9513);
}

/// K = rho c^2 A / z0 and 3 rho c^2 I / z0 of cones are the static stiffness, so their masses and
/// dashpots at high frequencies are those of the waves that the mat sends down.
TEST(Disk, ConesSendDownWavesAtHighFrequencies) {
  for (const double nu : {0.0, 0.25, 0.4, 0.49}) {
    const HalfSpace soil{250, 1900, nu};
    const double radius = 8;
    const double area = std::numbers::pi * radius * radius;
    const double velocity =
        soil.shear_velocity * (nu > 1.0 / 3 ? 2 : std::sqrt(2 * (1 - nu) / (1 - 2 * nu)));
    const Impedances disk = disk_impedances(soil, radius);
    const double omega = 1e6;
    const double inertia = area * radius * radius / 4;
    EXPECT_NEAR(disk[2].at(omega).imag() / (omega * 1900 * velocity * area), 1, 1e-8);
    EXPECT_NEAR(disk[3].at(omega).imag() / (omega * 1900 * velocity * inertia), 1, 1e-8);
    EXPECT_NEAR(disk[5].at(omega).imag() / (omega * 1900 * 250 * 2 * inertia), 1, 1e-8);
    // A rotational cone loses a third of its stiffness, trapped masses apart.
    const std::complex<double> rocking = disk[3].at(omega) + omega * omega * disk[3].mass;
    EXPECT_NEAR(rocking.real() / disk[3].stiffness, 2.0 / 3, 1e-6);
    EXPECT_EQ(disk[2].mass > 0, nu > 1.0 / 3);
    EXPECT_EQ(disk[3].mass > 0, nu > 1.0 / 3);
  }
}

TEST(Impedance, WithoutFrequencyDependenceHasTheRatesOfAZeroOne) {
  for (const bool disk : {false, true}) {
    const Footprint footprint{disk, {20, 14}, 0};
    const Impedances modes = impedances_of(third, footprint);
    const Impedances plain = without_frequency_dependence(modes, third, footprint);
    for (std::size_t c = 0; c < 6; ++c) {
      const double omega = third.shear_velocity / 7;
      EXPECT_EQ(plain[c].inner_mass, 0);
      EXPECT_EQ(plain[c].mass, 0);
      EXPECT_EQ(plain[c].stiffness, modes[c].stiffness);
      EXPECT_NEAR(plain[c].at(omega).imag() / modes[c].at(omega).imag(), 1, 1e-14);
      EXPECT_GT(plain[c].dashpot, 0);
    }
  }
}

TEST(Impedance, AtRestIsTheSpring) {
  for (const Impedance& mode : disk_impedances({200, 1800, 0.4}, 5)) {
    EXPECT_EQ(mode.at(0), std::complex<double>(mode.stiffness, 0));
  }
}

TEST(Impedance, OfAStifferGroundIsThatOfASlowerMotion) {
  for (const double factor : {0.5, 2.0}) {
    HalfSpace other = third;
    other.shear_velocity *= std::sqrt(factor);
    for (const Footprint& footprint :
         {Footprint{false, {20, 14}, 3}, Footprint{true, {16, 16}, 0}}) {
      const Impedances nominal = impedances_of(third, footprint);
      const Impedances stiffer = impedances_of(other, footprint);
      for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(stiffer[c].inner_mass, nominal[c].inner_mass, 1e-12 * nominal[c].inner_mass);
        for (const double omega : {0.0, 5.0, 40.0}) {
          const auto expected = factor * nominal[c].at(omega / std::sqrt(factor));
          EXPECT_LT(std::abs(stiffer[c].at(omega) - expected), 1e-12 * std::abs(expected));
        }
      }
    }
  }
}

}  // namespace impedance_test
}  // namespace pounding
