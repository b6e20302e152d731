#include "interactions/dashpot_modes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/batch_value.h"
#include "common/dense_matrix.h"

namespace pounding::interactions {
namespace dashpot_modes_test {

/// Eleven coordinates of different masses with dashpots of very different strengths between them.
struct Braked {
  static constexpr std::size_t size = 11;
  static constexpr double time_step = 1e-3;
  LinearSystem system;
  DashpotRows dashpots;
  std::vector<double> before;
  std::vector<double> free;

  explicit Braked(std::size_t count) {
    for (std::size_t i = 0; i < size; ++i) {
      const double x = static_cast<double>(i);
      system.lumped_mass.push_back(1 + 0.3 * x);
      system.inverse_mass.push_back(1 / system.lumped_mass.back());
      before.push_back(std::sin(3 * x));
      free.push_back(std::cos(2 * x) + 0.5);
    }
    for (std::size_t b = 0; b < count; ++b) {
      dashpots.strengths.push_back(std::pow(10.0, static_cast<double>(b % 5)));
      for (std::size_t i = 0; i < size; ++i) {
        dashpots.rows.push_back(std::cos(0.7 * static_cast<double>((2 * b + 1) * (i + 1) + b)));
      }
    }
  }

  /// Entry of C = B^T diag(c) B.
  double damping(std::size_t i, std::size_t j) const {
    double sum = 0;
    const auto& [rows, strengths] = dashpots;
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

TEST(DashpotBrake, AreTheDashpotsThemselves) {
  for (const std::size_t count : {1u, 5u, 8u, 20u}) {  // as rows, and as a full matrix
    for (const double share : {0.5, 1.0}) {
      const Braked braked(count);
      const DashpotModes all(braked.system, braked.dashpots, Braked::time_step);
      EXPECT_EQ(all.lambda.size(), std::min(count, Braked::size));
      DashpotBrake<double> modes(all);
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

TEST(DashpotBrake, LeaveAloneWhatTheyDoNotHold) {
  Braked braked(1);
  for (std::size_t i = 1; i < Braked::size; ++i) braked.dashpots.rows[i] = 0;
  const DashpotModes all(braked.system, braked.dashpots, Braked::time_step);
  ASSERT_EQ(all.lambda.size(), 1u);
  DashpotBrake<double> modes(all);
  std::vector<double> velocity = braked.free;
  modes.brake(1, braked.before, velocity);
  EXPECT_NE(velocity[0], braked.free[0]);
  for (std::size_t i = 1; i < Braked::size; ++i) EXPECT_NEAR(velocity[i], braked.free[i], 1e-15);
}

void expect_each_member(std::size_t count) {
  const Braked braked(count);
  DashpotBrake<double> one({braked.system, braked.dashpots, Braked::time_step});
  DashpotBrake<BatchValue> all({braked.system, braked.dashpots, Braked::time_step});
  std::vector<BatchValue> before(Braked::size, BatchValue{});
  std::vector<BatchValue> velocities(Braked::size, BatchValue{});
  const auto level = [](std::size_t member) { return 0.25 * static_cast<double>(member) - 1; };
  for (std::size_t member = 0; member < batch_size; ++member) {
    for (std::size_t i = 0; i < Braked::size; ++i) {
      before[i][member] = level(member) * braked.before[i];
      velocities[i][member] = level(member) * braked.free[i];
    }
  }
  all.brake(0.5, before, velocities);
  const BatchValue losses = all.loss(before, velocities);
  std::vector<double> velocity = braked.free;
  one.brake(0.5, braked.before, velocity);
  const double loss = one.loss(braked.before, velocity);
  for (std::size_t member = 0; member < batch_size; ++member) {
    EXPECT_NEAR(losses[member], level(member) * level(member) * loss, 1e-13 * loss);
    for (std::size_t i = 0; i < Braked::size; ++i) {
      EXPECT_NEAR(velocities[i][member], level(member) * velocity[i], 1e-13);
    }
  }
  // Contact that then moves a coordinate of one run.
  const double change = 0.01;
  const double rate = all.loss_rate(3)[6];
  velocities[3][6] += change;
  EXPECT_NEAR(all.loss(before, velocities)[6], losses[6] + rate * change, 1e-13 * loss);
}

TEST(DashpotBrake, BrakeEightRunsAsEachOfThem) {
  for (const std::size_t count : {5u, 20u}) expect_each_member(count);
}

}  // namespace dashpot_modes_test
}  // namespace pounding::interactions
