#include "soil/impedance_fit.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "common/dense_matrix.h"
#include "soil/disk.h"
#include "soil/nonnegative.h"
#include "soil/rectangle.h"

namespace pounding {
namespace impedance_fit_test {

using std::numbers::pi;

constexpr HalfSpace third{200, 2000, 1.0 / 3};

/// Samples of parts from the first frequency on, at equal steps.
ImpedanceTable table_of(const ImpedanceFit& parts, double first, double step, int count) {
  ImpedanceTable table;
  for (int i = 0; i < count; ++i) {
    const double f = first + step * i;
    table.frequency.push_back(f);
    table.impedance.push_back(parts.at(2 * pi * f));
  }
  return table;
}

ImpedanceFit of_modes(const Impedances& modes) {
  ImpedanceFit parts;
  for (std::size_t c = 0; c < modes.size(); ++c) {
    DirectedImpedance& part = parts.parts.emplace_back();
    part.motion[c] = 1;
    part.impedance = modes[c];
  }
  return parts;
}

double largest_misfit(const ImpedanceFit& fit) {
  double largest = 0;
  for (const BlockFit& block : fit.blocks) largest = std::max(largest, block.largest);
  return largest;
}

/// Every number of every part is one that only takes energy, and so is the whole at 600 frequencies
/// far below and far above the table.
void expect_passive(const ImpedanceFit& fit, const std::string& name) {
  for (const DirectedImpedance& part : fit.parts) {
    const Impedance& of = part.impedance;
    for (const double value :
         {of.stiffness, of.dashpot, of.inner_dashpot, of.inner_mass, of.mass, of.inner_stiffness}) {
      EXPECT_TRUE(std::isfinite(value) && value >= 0) << name;
    }
  }
  for (int i = 0; i <= 600; ++i) {
    const double omega = 2 * pi * std::pow(10.0, -4 + i / 75.0);
    const ImpedanceMatrix matrix = fit.at(omega);
    DenseMatrix real(6, 6);
    for (std::size_t a = 0; a < 6; ++a) {
      for (std::size_t b = 0; b < 6; ++b) {
        const double sizes = std::sqrt(std::abs(matrix[7 * a]) * std::abs(matrix[7 * b]));
        real.column(a)[b] = sizes > 0 ? matrix[6 * a + b].imag() / sizes : 0;
      }
    }
    EXPECT_GE(symmetric_eigenvalues(real).front(), -1e-12) << name << " " << omega;
  }
}

TEST(Nonnegative, MeetsTheConditionsOfTheLeastMisfit) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    DenseMatrix a(3 + trial % 20, 1 + trial % 11);
    for (double& value : a.values) value = normal(random) + (trial % 3 == 0 ? 1 : 0);
    std::vector<double> b(a.rows);
    for (double& value : b) value = normal(random);
    const std::vector<double> x = nonnegative_solution(a, b);
    std::vector<double> rest = b;
    for (std::size_t j = 0; j < a.columns; ++j) {
      for (std::size_t i = 0; i < a.rows; ++i) rest[i] -= a.column(j)[i] * x[j];
    }
    for (std::size_t j = 0; j < a.columns; ++j) {
      double slope = 0;
      for (std::size_t i = 0; i < a.rows; ++i) slope += a.column(j)[i] * rest[i];
      EXPECT_GE(x[j], 0);
      EXPECT_LE(slope, 1e-9 * double(a.rows)) << trial << " " << j;
      EXPECT_NEAR(slope * x[j], 0, 1e-9 * double(a.rows)) << trial << " " << j;
    }
  }
}

TEST(ImpedanceFit, OwnHalfSpacesComeBack) {
  for (const double embedment : {0.0, 4.0}) {
    for (const double ratio : {1.0, 2.0, 4.0}) {
      const auto parts = of_modes(rectangle_impedances(third, {20 * ratio, 20}, embedment));
      const ImpedanceFit fit = fit_impedances(table_of(parts, 0.25, 0.25, 80));
      EXPECT_LT(largest_misfit(fit), 1e-3) << ratio;
      EXPECT_EQ(fit.blocks.size(), 6U);
      expect_passive(fit, "rectangle");
      for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(fit.at(0)[7 * c].real() / parts.at(0)[7 * c].real(), 1, 1e-3) << c;
      }
    }
  }
  for (const double nu : {0.2, 1.0 / 3, 0.45}) {
    const auto parts = of_modes(disk_impedances({200, 2000, nu}, 10));
    const ImpedanceFit fit = fit_impedances(table_of(parts, 0.25, 0.25, 80));
    EXPECT_LT(largest_misfit(fit), 1e-3) << nu;
    expect_passive(fit, "disk");
  }
}

/// Springs and dashpots far below the mat's middle couple sliding with rocking.
TEST(ImpedanceFit, CoupledMotionsComeBackCoupled) {
  ImpedanceFit parts = of_modes(rectangle_impedances(third, {20, 30}, 0));
  parts.parts[0].motion[4] = -4;
  parts.parts[1].motion[3] = 4;
  const ImpedanceFit fit = fit_impedances(table_of(parts, 0.25, 0.25, 80));
  ASSERT_EQ(fit.blocks.size(), 4U);
  EXPECT_EQ(fit.blocks[0].motions, (std::array{true, false, false, false, true, false}));
  EXPECT_EQ(fit.blocks[1].motions, (std::array{false, true, false, true, false, false}));
  EXPECT_LT(largest_misfit(fit), 1e-3);
  expect_passive(fit, "coupled");
}

/// Random passive soils: up to six internal parts beside springs and dashpots, in random motions.
TEST(ImpedanceFit, RandomPassiveSoilIsMetAndPassive) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.1, 1);
  std::uniform_real_distribution<double> sign(-1, 1);
  for (int trial = 0; trial < 6; ++trial) {
    ImpedanceFit parts;
    for (std::size_t c = 0; c < 6; ++c) {
      DirectedImpedance& part = parts.parts.emplace_back();
      part.motion[c] = 1;
      part.impedance = {1e9, 1e7 * any(random), 0, 0, trial % 2 * 1e5 * any(random)};
    }
    for (int k = 0; k < 1 + trial % 6; ++k) {
      DirectedImpedance& part = parts.parts.emplace_back();
      part.motion[k % 2 == 0 ? 0 : 1] = sign(random);
      part.motion[k % 2 == 0 ? 4 : 3] = sign(random);
      part.impedance = {
          1e8 * any(random), 1e6 * any(random), 4e7 * any(random), 3e5 * any(random), 0,
          1e9 * any(random)};
      if (k % 3 == 1) part.impedance.inner_stiffness = 0;
      if (k % 3 == 2) part.impedance.inner_mass = 0;
    }
    const ImpedanceFit fit = fit_impedances(table_of(parts, 0.3, 0.3, 60));
    for (const BlockFit& block : fit.blocks) EXPECT_LT(block.mean, 0.02) << trial;
    expect_passive(fit, "random " + std::to_string(trial));
  }
}

/// Tables that no soil has, which nothing passive meets: what comes out is passive all the same.
TEST(ImpedanceFit, WhateverTheTableIsTheFitIsPassive) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 12; ++trial) {
    ImpedanceTable table;
    for (int i = 0; i < 12; ++i) {
      table.frequency.push_back(0.5 * (i + 1));
      ImpedanceMatrix& matrix = table.impedance.emplace_back();
      for (std::size_t a = 0; a < 6; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          const double part = a == b ? 1 : a == b + 4 ? 0.5 : 0;
          matrix[6 * a + b] = matrix[6 * b + a] =
              part * 1e9 * std::complex<double>(normal(random), normal(random));
        }
      }
    }
    const ImpedanceFit fit = fit_impedances(table);
    expect_passive(fit, "noise " + std::to_string(trial));
    EXPECT_GT(largest_misfit(fit), 0.1);
  }
}

/// A loss that does not depend on the frequency is met as far as passive soil can, and the spring
/// of the soil at rest stays what it is.
TEST(ImpedanceFit, StaticStiffnessOfHystereticSoilIsKept) {
  ImpedanceTable table =
      table_of(of_modes(rectangle_impedances(third, {20, 20}, 0)), 0.25, 0.25, 80);
  for (ImpedanceMatrix& matrix : table.impedance) {
    for (std::size_t c = 0; c < 6; ++c) {
      matrix[7 * c] += std::complex<double>(0, 0.1 * table.impedance[0][7 * c].real());
    }
  }
  const ImpedanceFit fit = fit_impedances(table);
  expect_passive(fit, "hysteretic");
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(fit.at(0)[7 * c].real() / table.impedance[0][7 * c].real(), 1, 0.05) << c;
  }
  for (const BlockFit& block : fit.blocks) EXPECT_LT(block.mean, 0.03);
}

}  // namespace impedance_fit_test
}  // namespace pounding
