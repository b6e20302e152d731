#include "contact/friction_solver.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/full_rows.h"

namespace pounding {
namespace {

/// Points on bodies with so many motions: H = J J^T, singular when there are fewer than rows.
struct Example {
  std::vector<double> delassus;
  std::vector<double> rate;
  std::vector<double> coefficient;
  mutable SparseRows sparse;  ///< delassus as problem() shows it

  Example(std::size_t points, std::size_t motions, unsigned seed, double friction) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const std::size_t n = 3 * points;
    std::vector<double> rows(n * motions);
    for (double& value : rows) value = normal(random);
    delassus.assign(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < motions; ++k) {
          delassus[i * n + j] += rows[i * motions + k] * rows[j * motions + k];
        }
      }
    }
    std::vector<double> velocity(motions);
    for (double& value : velocity) value = normal(random);
    rate.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < motions; ++k) rate[i] += rows[i * motions + k] * velocity[k];
    }
    coefficient.assign(points, friction);
  }
  FrictionProblem problem() const {
    sparse = full_rows(delassus);
    return {sparse, rate, coefficient};
  }
  std::vector<double> after(const std::vector<double>& impulse) const {
    std::vector<double> v = rate;
    for (std::size_t i = 0; i < v.size(); ++i) {
      for (std::size_t j = 0; j < v.size(); ++j) v[i] += delassus[i * v.size() + j] * impulse[j];
    }
    return v;
  }
};

/// Coulomb's law, word for word.
void expect_law(const Example& example, const std::vector<double>& impulse, double tolerance) {
  const std::vector<double> v = example.after(impulse);
  double scale = 0;
  double most = 0;
  for (const double value : example.rate) scale = std::max(scale, std::abs(value));
  for (const double value : impulse) most = std::max(most, std::abs(value));
  for (std::size_t i = 0; i < impulse.size(); i += 3) {
    const double mu = example.coefficient[i / 3];
    EXPECT_GE(impulse[i], 0);
    EXPECT_GE(v[i], -tolerance * scale);
    EXPECT_LE(impulse[i] * v[i], tolerance * scale * most);
    const double size = std::hypot(impulse[i + 1], impulse[i + 2]);
    const double slip = std::hypot(v[i + 1], v[i + 2]);
    EXPECT_LE(size, mu * impulse[i] + tolerance * most);
    if (size < mu * impulse[i] - tolerance * most) {
      EXPECT_LE(slip, 10 * tolerance * scale);
    }
    // Friction looks against the slip: never gives energy, and all of it is along the slip.
    const double power = impulse[i + 1] * v[i + 1] + impulse[i + 2] * v[i + 2];
    EXPECT_NEAR(power, -size * slip, 10 * tolerance * scale * most);
  }
}

TEST(FrictionSolver, FulfilsCoulombsLawOnRandomBodies) {
  for (const double friction : {0.05, 0.3, 0.8}) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
      const std::size_t points = 1 + seed % 9;
      const Example example(points, 3 * points + 4, seed, friction);
      std::vector<double> impulse(3 * points, 0.0);
      FrictionSolver solver(points);
      const FrictionResult result = solver.solve(example.problem(), impulse);
      EXPECT_LT(result.residual, 1e-12) << "seed " << seed << " mu " << friction;
      EXPECT_EQ(result.residual, friction_residual(example.problem(), impulse));
      expect_law(example, impulse, 1e-11);
    }
  }
}

TEST(FrictionSolver, SolvesSingularProblems) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const std::size_t points = 4 + seed % 7;
    const Example example(points, 6, seed, 0.4);  // one rigid body
    std::vector<double> impulse(3 * points, 0.0);
    FrictionSolver solver(points);
    const FrictionResult result = solver.solve(example.problem(), impulse);
    EXPECT_LT(result.residual, 1e-11) << "seed " << seed;
  }
}

TEST(FrictionSolver, PointAloneIsInClosedForm) {
  const double h = 0.25;
  const SparseRows delassus = full_rows({h, 0, 0, 0, h, 0, 0, 0, h});
  const std::vector<double> coefficient{0.5};
  FrictionSolver solver(1);
  std::vector<double> impulse(3, 7.0);
  const FrictionResult slips =
      solver.solve({delassus, std::vector{-1.0, 3.0, 4.0}, coefficient}, impulse);
  EXPECT_EQ(slips.sweeps + slips.iterations, 0);
  EXPECT_EQ(impulse[0], 4);
  EXPECT_NEAR(impulse[1], -2 * 0.6, 1e-15);
  EXPECT_NEAR(impulse[2], -2 * 0.8, 1e-15);
  solver.solve({delassus, std::vector{-1.0, 0.3, 0.4}, coefficient}, impulse);  // sticks
  EXPECT_NEAR(impulse[1], -1.2, 1e-15);
  EXPECT_NEAR(impulse[2], -1.6, 1e-15);
  solver.solve({delassus, std::vector{1.0, 3.0, 4.0}, coefficient}, impulse);  // leaves
  EXPECT_EQ(impulse, (std::vector<double>{0, 0, 0}));
}

TEST(FrictionSolver, WithoutFrictionPushesAlongTheNormalAlone) {
  const Example example(5, 20, 3, 0);
  std::vector<double> impulse(15, 0.0);
  FrictionSolver solver(5);
  EXPECT_LT(solver.solve(example.problem(), impulse).residual, 1e-12);
  for (std::size_t i = 0; i < 15; i += 3) {
    EXPECT_EQ(impulse[i + 1], 0);
    EXPECT_EQ(impulse[i + 2], 0);
  }
}

TEST(FrictionSolver, DiskIsSolvedForAnyMobility) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double spread = std::pow(10.0, 6 * uniform(random));
    const double angle = 3.14159 * uniform(random);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double matrix[3] = {c * c + spread * s * s, c * s * (1 - spread), s * s + spread * c * c};
    const double rate[2] = {uniform(random), uniform(random)};
    const double radius = std::pow(10.0, 4 * uniform(random));
    double x[2];
    solve_on_disk(matrix, rate, radius, x);
    const double v[2] = {rate[0] + matrix[0] * x[0] + matrix[1] * x[1],
                         rate[1] + matrix[1] * x[0] + matrix[2] * x[1]};
    const double size = std::hypot(x[0], x[1]);
    const double slip = std::hypot(v[0], v[1]);
    EXPECT_LE(size, radius * (1 + 1e-14));
    const double round_off = 1e-12 * (1 + (1 + spread) * size);
    if (size < radius * (1 - 1e-12)) {
      EXPECT_LE(slip, round_off);
    } else {
      EXPECT_NEAR(x[0] * v[0] + x[1] * v[1], -size * slip, 10 * size * round_off);
    }
  }
  double x[2];
  const double one_way[3] = {2, 0, 0};  // the second direction does not move
  const double rate[2] = {-1, 5};
  solve_on_disk(one_way, rate, 10, x);
  EXPECT_NEAR(x[0], 0.5, 1e-15);
  EXPECT_EQ(x[1], 0);
}

TEST(FrictionSolver, GivesTheSameBitsAndMindsBadNumbers) {
  const Example example(6, 25, 11, 0.3);
  std::vector<double> first(18, 0.0);
  std::vector<double> second(18, 0.0);
  FrictionSolver solver(8);
  solver.solve(example.problem(), first);
  const Example other(8, 30, 12, 0.6);
  std::vector<double> between(24, 0.0);
  solver.solve(other.problem(), between);
  solver.solve(example.problem(), second);
  EXPECT_EQ(first, second);
  std::vector<double> rate = example.rate;
  rate[4] = std::numeric_limits<double>::quiet_NaN();
  const FrictionResult bad =
      solver.solve({example.problem().delassus, rate, example.coefficient}, second);
  EXPECT_FALSE(bad.finite);
  EXPECT_TRUE(std::isinf(bad.residual));
  EXPECT_EQ(second, std::vector<double>(18, 0.0));
}

/// Masses that differ by six orders, as a light node on a heavy floor.
TEST(FrictionSolver, UnequalMassesAreSolved) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Example example(4, 18, seed, 0.5);
    const std::size_t n = 12;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double a = i / 3 % 2 == 0 ? 1 : 1e-3;
        const double b = j / 3 % 2 == 0 ? 1 : 1e-3;
        example.delassus[i * n + j] *= a * b;
      }
      if (i / 3 % 2 == 1) example.rate[i] *= 1e-3;
    }
    std::vector<double> impulse(n, 0.0);
    FrictionSolver solver(4);
    EXPECT_LT(solver.solve(example.problem(), impulse).residual, 1e-11) << "seed " << seed;
  }
}

}  // namespace
}  // namespace pounding
