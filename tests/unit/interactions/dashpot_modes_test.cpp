#include "interactions/dashpot_modes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/dense_solver.h"

namespace pounding::interactions {
namespace dashpot_modes_test {

/// Seven coordinates of different masses with dashpots of very different strengths between them.
struct Braked {
  static constexpr std::size_t size = 7;
  static constexpr double time_step = 1e-3;
  LinearSystem system;
  std::vector<double> rows;
  std::vector<double> strengths;
  std::vector<double> before;
  std::vector<double> free;

  explicit Braked(std::size_t dashpots) {
    for (std::size_t i = 0; i < size; ++i) {
      const double x = static_cast<double>(i);
      system.lumped_mass.push_back(1 + 0.3 * x);
      system.inverse_mass.push_back(1 / system.lumped_mass.back());
      before.push_back(std::sin(3 * x));
      free.push_back(std::cos(2 * x) + 0.5);
    }
    for (std::size_t b = 0; b < dashpots; ++b) {
      strengths.push_back(std::pow(10.0, static_cast<double>(b % 5)));
      for (std::size_t i = 0; i < size; ++i) {
        rows.push_back(std::cos(0.7 * static_cast<double>((2 * b + 1) * (i + 1) + b)));
      }
    }
  }

  /// Entry of C = B^T diag(c) B.
  double damping(std::size_t i, std::size_t j) const {
    double sum = 0;
    for (std::size_t b = 0; b < strengths.size(); ++b) {
      sum += strengths[b] * rows[b * size + i] * rows[b * size + j];
    }
    return sum;
  }

  /// v+ of (M + h C) v+ = M v_free - h C v-.
  std::vector<double> solved(double share) const {
    const double h = share * time_step / 2;
    std::vector<double> matrix(size * size);
    std::vector<double> values(size);
    for (std::size_t i = 0; i < size; ++i) {
      values[i] = system.lumped_mass[i] * free[i];
      for (std::size_t j = 0; j < size; ++j) {
        matrix[i * size + j] = (i == j ? system.lumped_mass[i] : 0) + h * damping(i, j);
        values[i] -= h * damping(i, j) * before[j];
      }
    }
    EXPECT_TRUE(solve_dense(matrix, values));
    return values;
  }
};

TEST(DashpotModes, AreTheDashpotsThemselves) {
  for (const std::size_t dashpots : {1u, 4u, 20u}) {
    for (const double share : {0.5, 1.0}) {
      const Braked braked(dashpots);
      DashpotModes modes(braked.system, braked.rows, braked.strengths, Braked::time_step);
      EXPECT_EQ(modes.size(), std::min(dashpots, Braked::size));
      std::vector<double> velocity = braked.free;
      modes.brake(share, braked.before, velocity);
      const std::vector<double> expected = braked.solved(share);
      double loss = 0;  // dt vbar^T C vbar
      for (std::size_t i = 0; i < Braked::size; ++i) {
        EXPECT_NEAR(velocity[i], expected[i], 1e-12);
        EXPECT_EQ(modes.sums()[i], velocity[i] + braked.before[i]);
        for (std::size_t j = 0; j < Braked::size; ++j) {
          loss += Braked::time_step / 4 * modes.sums()[i] * braked.damping(i, j) * modes.sums()[j];
        }
      }
      EXPECT_NEAR(modes.loss(braked.before, velocity), loss, 1e-12 * (1 + loss));
    }
  }
}

TEST(DashpotModes, LeaveAloneWhatTheyDoNotHold) {
  Braked braked(1);
  for (std::size_t i = 1; i < Braked::size; ++i) braked.rows[i] = 0;
  DashpotModes modes(braked.system, braked.rows, braked.strengths, Braked::time_step);
  ASSERT_EQ(modes.size(), 1u);
  std::vector<double> velocity = braked.free;
  modes.brake(1, braked.before, velocity);
  EXPECT_NE(velocity[0], braked.free[0]);
  for (std::size_t i = 1; i < Braked::size; ++i) EXPECT_NEAR(velocity[i], braked.free[i], 1e-15);
}

}  // namespace dashpot_modes_test
}  // namespace pounding::interactions
