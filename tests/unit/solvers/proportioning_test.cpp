#include "solvers/proportioning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/array_reductions.h"
#include "solvers/lcp.h"
#include "support/full_rows.h"
#include "support/plates.h"

namespace pounding::interactions {
namespace proportioning_test {

using Vector = std::vector<double>;

Vector dense(const SparseRows& matrix) {
  const std::size_t n = matrix.rows();
  Vector full(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k) {
      full[i * n + static_cast<std::size_t>(matrix.column[k])] = matrix.value[k];
    }
  }
  return full;
}

struct Answer {
  LcpResult result;
  Vector impulse;
};

Answer solve(const SparseRows& delassus, const Vector& rate, Vector guess = {}) {
  ProportioningSolver solver(delassus);
  guess.resize(rate.size());
  Answer answer{{}, std::move(guess)};
  answer.result = solver.solve(first_places(rate.size()), rate, answer.impulse);
  return answer;
}

TEST(Proportioning, AgreesWithTheExactSolver) {
  for (const double heavier : {1e-2, 1.0, 1e3}) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Plates plates(13, 7 + static_cast<int>(seed), heavier, seed);
      const Answer answer = solve(plates.delassus, plates.rate);
      Vector exact(plates.rows());
      LcpSolver(static_cast<int>(plates.rows())).solve(dense(plates.delassus), plates.rate, exact);
      EXPECT_EQ(answer.result.method, LcpMethod::active_set);
      EXPECT_LE(answer.result.residual, 20 * answer.result.roundoff);
      EXPECT_NEAR(answer.result.residual,
                  complementarity_residual(dense(plates.delassus), plates.rate, answer.impulse),
                  1e-18);
      const double scale = largest_magnitude(exact);
      for (std::size_t i = 0; i < exact.size(); ++i) {
        EXPECT_NEAR(answer.impulse[i], exact[i], 1e-12 * scale) << "row " << i;
      }
    }
  }
}

TEST(Proportioning, NeedsAsManyProductsForTenThousandRowsAsForFew) {
  const Plates few(20, 15, 1, 1);
  const Plates many(100, 77, 1, 1);
  const Answer small = solve(few.delassus, few.rate);
  const Answer large = solve(many.delassus, many.rate);
  EXPECT_EQ(large.result.method, LcpMethod::active_set);
  EXPECT_LE(large.result.residual, 1e-14);
  EXPECT_LE(large.result.iterations, 60);
  EXPECT_LE(large.result.iterations, 2 * small.result.iterations);
}

/// More rows than motions: H has no inverse, the impulses are not unique, the velocities are.
TEST(Proportioning, SolvesASingularDelassus) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  constexpr std::size_t rows = 120;
  constexpr std::size_t motions = 30;
  Vector constraints(rows * motions);
  for (double& value : constraints) value = normal(random);
  Vector delassus(rows * rows);
  Vector rate(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t k = 0; k < motions; ++k) {
        delassus[i * rows + j] += constraints[i * motions + k] * constraints[j * motions + k];
      }
    }
    for (std::size_t k = 0; k < motions; ++k)
      rate[i] += constraints[i * motions + k] * (k % 3 - 1.0);
  }
  const Answer answer = solve(full_rows(delassus), rate);
  EXPECT_EQ(answer.result.method, LcpMethod::active_set);
  EXPECT_LE(answer.result.residual, 20 * answer.result.roundoff);
  const Answer other = solve(full_rows(delassus), rate, Vector(rows, 1.0));
  for (std::size_t i = 0; i < rows; ++i) {
    double difference = 0;
    for (std::size_t j = 0; j < rows; ++j) {
      difference += delassus[i * rows + j] * (answer.impulse[j] - other.impulse[j]);
    }
    EXPECT_NEAR(difference, 0, 1e-10) << "row " << i;
  }
}

/// A rigid plate on one that is not: far more rows than motions, and steps that could go on along
/// impulses that nothing feels. They end at round-off, also where rates have more of it than H.
TEST(Proportioning, EndsAtRoundOffWhereManyRowsHoldARigidBody) {
  for (const int nodes : {13, 17, 25}) {
    const Plates plates(nodes, 2 * nodes / 3, 1, 3);
    const std::size_t rows = plates.rows();
    const auto place = [&](std::size_t i) {
      const auto row = static_cast<double>(i / static_cast<std::size_t>(nodes));
      return std::pair{row / (nodes - 1) - 0.5,
                       (static_cast<double>(i) - row * nodes) / (nodes - 1) - 0.5};
    };
    Vector delassus = dense(plates.delassus);
    for (std::size_t i = 0; i < rows; ++i) {
      delassus[i * rows + i] -= nodes * nodes;
      for (std::size_t j = 0; j < rows; ++j) {
        const auto [y, z] = place(i);
        const auto [other_y, other_z] = place(j);
        delassus[i * rows + j] += 1 + 12 * (y * other_y + z * other_z);
      }
    }
    for (const double turning : {0.0, 0.3}) {
      for (const double noise : {0.0, 1e-14}) {
        Vector rate(rows);
        for (std::size_t i = 0; i < rows; ++i) {
          const auto [y, z] = place(i);
          rate[i] = -1 + turning * (y - 2 * z) + noise * std::sin(static_cast<double>(i * i));
        }
        const Answer answer = solve(full_rows(delassus), rate);
        EXPECT_LE(answer.result.iterations, 600);
        EXPECT_LE(answer.result.residual, noise > 0 ? 1e-13 : 5e-15);
      }
    }
  }
}

TEST(Proportioning, GivesTheSameBitsAndScalesWithTheRates) {
  const Plates plates(15, 11, 1, 3);
  const Answer answer = solve(plates.delassus, plates.rate);
  EXPECT_EQ(answer.impulse, solve(plates.delassus, plates.rate).impulse);
  Vector rate = plates.rate;
  for (double& value : rate) value *= 0x1p-600;
  const Answer tiny = solve(plates.delassus, rate);
  for (std::size_t i = 0; i < rate.size(); ++i) {
    EXPECT_EQ(tiny.impulse[i], answer.impulse[i] * 0x1p-600);
  }
}

TEST(Proportioning, StartsFromAnyGuess) {
  const Plates plates(15, 11, 1, 3);
  const Answer answer = solve(plates.delassus, plates.rate);
  const Answer again = solve(plates.delassus, plates.rate, answer.impulse);
  EXPECT_LE(again.result.iterations, 6);
  Vector bad(plates.rows(), -7.0);
  bad[3] = std::numeric_limits<double>::quiet_NaN();
  bad[5] = 1e30;
  const Answer other = solve(plates.delassus, plates.rate, bad);
  EXPECT_EQ(other.result.method, LcpMethod::active_set);
  const double scale = largest_magnitude(answer.impulse);
  for (std::size_t i = 0; i < bad.size(); ++i) {
    EXPECT_NEAR(other.impulse[i], answer.impulse[i], 1e-11 * scale);
    EXPECT_NEAR(again.impulse[i], answer.impulse[i], 1e-13 * scale);
  }
}

TEST(Proportioning, SaysWhatCannotBe) {
  const Plates plates(11, 7, 1, 3);
  Vector rate = plates.rate;
  rate[4] = std::numeric_limits<double>::infinity();
  const Answer bad = solve(plates.delassus, rate);
  EXPECT_EQ(bad.result.method, LcpMethod::not_finite);
  EXPECT_TRUE(std::ranges::all_of(bad.impulse, [](double value) { return value == 0; }));
  std::ranges::fill(rate, 0.5);
  EXPECT_EQ(solve(plates.delassus, rate).result.method, LcpMethod::separated);
  SparseRows immobile;  // two rows that move, one that nothing opens
  for (const double h : {2.0, 0.0, 4.0}) {
    immobile.add(static_cast<int>(immobile.rows()), h);
    immobile.end_row();
  }
  const Answer stuck = solve(immobile, {-1, -1, -1});
  EXPECT_EQ(stuck.result.infeasible_rows, 1);
  EXPECT_DOUBLE_EQ(stuck.impulse[0], 0.5);
  EXPECT_EQ(stuck.impulse[1], 0);
  EXPECT_DOUBLE_EQ(stuck.impulse[2], 0.25);
}

TEST(Proportioning, CorrectionRemovesTheRatesOfRowsInContact) {
  const Plates plates(13, 9, 1, 5);
  ProportioningSolver solver(plates.delassus);
  Vector impulse(plates.rows());
  solver.solve(first_places(plates.rows()), plates.rate, impulse);
  const Vector before = impulse;
  Vector left(plates.rows());
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] = 1e-9 * std::sin(static_cast<double>(i));
  }
  Vector increment(plates.rows());
  solver.correct(left, impulse, increment);
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(impulse[i], before[i] + increment[i]);
    const double rate = left[i] + row_product(plates.delassus, i, increment);
    if (impulse[i] > 0) {
      EXPECT_NEAR(rate, 0, 1e-16) << "row " << i;
    } else {
      EXPECT_EQ(increment[i], -before[i]) << "row " << i;
    }
  }
}

/// Rows that are not active are as if they were not there, and leave nothing behind.
TEST(Proportioning, SolvesForTheActiveRowsAlone) {
  const Plates plates(15, 11, 1, 6);
  ProportioningSolver solver(plates.delassus);
  for (const int kept : {1, 2, 3, 30}) {
    std::vector<std::size_t> active;
    std::vector<int> number(plates.rows(), -1);
    Vector rate;
    for (std::size_t i = 0; i < plates.rows(); ++i) {
      if (static_cast<int>(i * i) % 31 >= kept) continue;
      number[i] = static_cast<int>(active.size());
      active.push_back(i);
      rate.push_back(plates.rate[i]);
    }
    SparseRows part;
    take_principal_part(plates.delassus, number, part);
    const Answer alone = solve(part, rate);
    Vector impulse(active.size());
    const LcpResult result = solver.solve(active, rate, impulse);
    EXPECT_EQ(result.method, LcpMethod::active_set);
    EXPECT_LE(result.residual, 2e-15);
    for (std::size_t k = 0; k < active.size(); ++k) {
      EXPECT_NEAR(impulse[k], alone.impulse[k], 1e-13 * largest_magnitude(alone.impulse));
    }
  }
}

TEST(CoupledLcp, BothSolversAnswerAlikeAtTheirBorder) {
  for (const int nodes : {9, 10}) {  // 81 and 100 rows
    const Plates plates(nodes, 7, 1, 2);
    CoupledLcp solver(plates.rows());
    ProportioningSolver many(plates.delassus);
    Vector impulse(plates.rows());
    const LcpResult result =
        solver.solve({}, &many, first_places(plates.rows()), plates.rate, impulse);
    const Answer sparse = solve(plates.delassus, plates.rate);
    EXPECT_LE(result.residual, 1e-14);
    for (std::size_t i = 0; i < impulse.size(); ++i) {
      EXPECT_NEAR(impulse[i], sparse.impulse[i], 1e-13 * largest_magnitude(impulse));
    }
  }
}

}  // namespace proportioning_test
}  // namespace pounding::interactions
