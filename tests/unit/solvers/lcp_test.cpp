#include "solvers/lcp.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/source_folder.h"

namespace pounding::interactions {
namespace lcp_test {

using Vector = std::vector<double>;

double largest(const Vector& values) {
  double worst = 0;
  for (double value : values) worst = std::max(worst, std::abs(value));
  return worst;
}

/// Masses that meet under constraints L, shape (rows, dofs) row-major.
struct Collision {
  std::size_t rows = 0, dofs = 0;
  Vector constraints, inverse_mass, free_velocity;

  Collision(const std::vector<Vector>& l, const Vector& mass, Vector velocity)
      : rows(l.size()), dofs(mass.size()), free_velocity(std::move(velocity)) {
    for (const Vector& row : l) constraints.insert(constraints.end(), row.begin(), row.end());
    for (double m : mass) inverse_mass.push_back(1 / m);
  }
  Vector delassus() const {
    Vector h(rows * rows);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t k = 0; k < dofs; ++k) {
          h[i * rows + j] +=
              constraints[i * dofs + k] * inverse_mass[k] * constraints[j * dofs + k];
        }
      }
    }
    return h;
  }
  Vector gap_rate(const Vector& velocity) const {
    Vector rate(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < dofs; ++k) rate[i] += constraints[i * dofs + k] * velocity[k];
    }
    return rate;
  }
  Vector nodal_impulse(const Vector& impulse) const {
    Vector sum(dofs);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < dofs; ++k) sum[k] += constraints[i * dofs + k] * impulse[i];
    }
    return sum;
  }
  void apply(const Vector& impulse, Vector& velocity) const {
    const Vector sum = nodal_impulse(impulse);
    for (std::size_t k = 0; k < dofs; ++k) velocity[k] += inverse_mass[k] * sum[k];
  }
};

struct Outcome {
  Vector impulse, velocity;
  LcpResult result;
};

Outcome collide(const Collision& collision, bool corrected = true) {
  LcpSolver solver(static_cast<int>(collision.rows));
  const Vector h = collision.delassus(), b = collision.gap_rate(collision.free_velocity);
  Outcome out{Vector(collision.rows), collision.free_velocity, {}};
  out.result = solver.solve(h, b, out.impulse);
  collision.apply(out.impulse, out.velocity);
  if (corrected) {
    Vector increment(collision.rows);
    solver.correct(collision.gap_rate(out.velocity), out.impulse, increment);
    collision.apply(increment, out.velocity);
  }
  return out;
}

/// The acceptance of every outcome: no closing gap, no pull, no impulse on an opening gap.
void expect_complementary(const Collision& collision, const Outcome& out) {
  const Vector rate = collision.gap_rate(out.velocity);
  const double scale = largest(collision.gap_rate(collision.free_velocity));
  const double total = std::accumulate(out.impulse.begin(), out.impulse.end(), 0.0);
  double work = 0;
  for (std::size_t i = 0; i < collision.rows; ++i) {
    EXPECT_GE(rate[i], -1e-10 * std::max(1.0, scale)) << "row " << i;
    EXPECT_GE(out.impulse[i], 0) << "row " << i;
    work += out.impulse[i] * rate[i];
  }
  EXPECT_LE(std::abs(work), 1e-12 * total * scale);
  EXPECT_NE(out.result.method, LcpMethod::stalled);
  EXPECT_LE(out.result.residual, std::max(1e-12, 10 * out.result.roundoff));
}

void expect_near(const Vector& actual, const Vector& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_NEAR(actual[i], expected[i], tolerance) << "entry " << i;
  }
}

/// Collisions with their known outcome, see tests/references/README.md.
nlohmann::json read_collisions() {
  std::ifstream file(source_folder() + "/tests/references/collisions.json");
  return nlohmann::json::parse(file);
}

Collision collision_of(const nlohmann::json& entry) {
  return {entry["rows"].get<std::vector<Vector>>(), entry["mass"].get<Vector>(),
          entry["before"].get<Vector>()};
}

/// A row of masses that touch: gap k between mass k and mass k + 1.
std::vector<Vector> chain_constraints(std::size_t masses) {
  std::vector<Vector> l(masses - 1, Vector(masses));
  for (std::size_t k = 0; k + 1 < masses; ++k) {
    l[k][k] = -1;
    l[k][k + 1] = 1;
  }
  return l;
}

/// Masses on each other and on the ground, pulled down by gravity for one step.
Collision tower(const Vector& mass, double speed) {
  std::vector<Vector> l(mass.size(), Vector(mass.size()));
  for (std::size_t k = 0; k < mass.size(); ++k) {
    l[k][k] = 1;
    if (k > 0) l[k][k - 1] = -1;
  }
  return {l, mass, Vector(mass.size(), -speed)};
}

TEST(Lcp, PlasticImpactOfTwoMassesKeepsMomentumUpToMassRatio1e12) {
  for (const double other : {1.0, 7000.0, 1e8, 1e-8, 1e12}) {
    const Outcome out = collide({{{-1, 1}}, {1, other}, {1, 0}});
    EXPECT_EQ(out.result.method, LcpMethod::diagonal);
    EXPECT_NEAR(out.impulse[0], other / (1 + other), 1e-15 * other / (1 + other));
    EXPECT_NEAR(out.velocity[0], 1 / (1 + other), 3e-16);
    EXPECT_NEAR(out.velocity[1], 1 / (1 + other), 3e-16);
  }
}

TEST(Lcp, SeparatingGapsReceiveNoImpulseWhateverTheGuess) {
  LcpSolver solver(2);
  const Vector h{2, 1, 1, 2}, b{0.5, 0};
  Vector impulse{3, 4};
  EXPECT_EQ(solver.solve(h, b, impulse).method, LcpMethod::separated);
  EXPECT_EQ(impulse, (Vector{0, 0}));
}

TEST(Lcp, AnImpulseNextDoorCanCloseOrOpenAGap) {
  // w = 0 on both: 2 x - y = 3, 2 y - x = -1. Row 1 alone would close gap 2, w_2 = 1 - 3/2.
  LcpSolver solver(2);
  Vector impulse(2);
  EXPECT_LT(solver.solve(Vector{2, -1, -1, 2}, Vector{-3, 1}, impulse).residual, 1e-16);
  expect_near(impulse, {5.0 / 3, 1.0 / 3}, 1e-15);
  // H = [2 1; 1 2], b = [-3, -1]: row 1 alone opens gap 2, w_2 = 1/2.
  std::fill(impulse.begin(), impulse.end(), 0.0);
  EXPECT_EQ(solver.solve(Vector{2, 1, 1, 2}, Vector{-3, -1}, impulse).residual, 0);
  EXPECT_EQ(impulse, (Vector{1.5, 0}));
}

TEST(Lcp, ChainsOfAnyMassRatioLeaveWithTheCommonVelocity) {
  for (const double light : {1.0, 1e-2, 1e-4, 1e-8}) {
    Vector mass(9, 1.0), velocity(9);
    for (std::size_t k = 0; k < 9; ++k) velocity[k] = 1 - 0.25 * static_cast<double>(k);
    for (std::size_t k = 1; k < 9; k += 2) mass[k] = light;
    const Collision chain(chain_constraints(9), mass, velocity);
    const Outcome out = collide(chain);
    expect_complementary(chain, out);
    expect_near(out.velocity, Vector(9, 0.0), 1e-14);  // by symmetry
  }
}

TEST(Lcp, TowerBearsTheWeightAboveEachContact) {
  for (const double ratio : {1.0, 10.0, 0.1, 0.01}) {
    Vector mass{1};
    while (mass.size() < 10) mass.push_back(ratio * mass.back());
    const Collision stack = tower(mass, 9.81e-3);
    const Outcome out = collide(stack);
    double weight = 0;
    for (std::size_t k = mass.size(); k-- > 0;) {
      weight += 9.81e-3 * mass[k];
      EXPECT_NEAR(out.impulse[k], weight, 1e-13 * weight) << "ratio " << ratio << " contact " << k;
    }
    EXPECT_LE(largest(stack.gap_rate(out.velocity)), 1e-14 * 9.81e-3);
  }
}

TEST(Lcp, CorrectionBringsGapRatesBelowTheRoundoffOfTheMatrix) {
  Vector mass(9, 1.0);
  for (std::size_t k = 1; k < 9; k += 2) mass[k] = 1e-8;
  const Collision chain(chain_constraints(9), mass, {1, .75, .5, .25, 0, -.25, -.5, -.75, -1});
  const Outcome plain = collide(chain, false), corrected = collide(chain);
  EXPECT_GT(plain.result.roundoff, 1e-9);
  EXPECT_GT(largest(chain.gap_rate(plain.velocity)), 1e-10);
  EXPECT_LT(largest(chain.gap_rate(corrected.velocity)), 1e-15);
}

TEST(Lcp, RedundantAndOpposingRowsGiveTheirUniqueVelocities) {
  const double common = (-0.3 * 9200 + 0.2 * 7000) / 16200;
  const Collision duplicate({{1, -1}, {1, -1}, {1, -1}}, {9200, 7000}, {-0.3, 0.2});
  expect_near(collide(duplicate).velocity, {common, common}, 1e-15);
  const Collision opposing({{1, -1}, {-1, 1}}, {9200, 7000}, {-0.3, 0.2});
  expect_near(collide(opposing).velocity, {common, common}, 1e-15);
  const Collision edge({{1, 0}, {0.5, 0.5}, {0, 1}}, {1, 1}, {-1, -1});
  const Outcome out = collide(edge);
  expect_near(edge.nodal_impulse(out.impulse), {1, 1}, 1e-15);
  EXPECT_EQ(out.result.dependent_rows, 1);
  for (const Collision& collision : {duplicate, opposing, edge}) {
    expect_complementary(collision, collide(collision));
  }
}

TEST(Lcp, RowsWithoutMassGetNoImpulseAndAreReportedIfTheyClose) {
  LcpSolver solver(3);
  const Vector h{2, 1, 0, 1, 2, 0, 0, 0, 0};
  Vector impulse{0, 0, 5};
  LcpResult result = solver.solve(h, Vector{-1, -1, 0}, impulse);
  expect_near(impulse, {1.0 / 3, 1.0 / 3, 0}, 1e-16);
  EXPECT_EQ(result.infeasible_rows, 0);
  EXPECT_LT(result.residual, 1e-15);
  result = solver.solve(h, Vector{-1, -1, -0.5}, impulse);
  expect_near(impulse, {1.0 / 3, 1.0 / 3, 0}, 1e-16);
  EXPECT_EQ(result.infeasible_rows, 1);
  EXPECT_NEAR(result.residual, 0.5, 1e-15);
}

TEST(Lcp, BadNumbersAreReportedAndNeverPassedOn) {
  LcpSolver solver(2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Vector impulse{1, 1};
  EXPECT_EQ(solver.solve(Vector{1, 0, 0, 1}, Vector{-1, nan}, impulse).method,
            LcpMethod::not_finite);
  EXPECT_EQ(impulse, (Vector{0, 0}));
  EXPECT_EQ(solver.solve(Vector{nan, 0, 0, 1}, Vector{-1, 1}, impulse).method,
            LcpMethod::not_finite);
  impulse = {nan, -2};  // a bad guess is no guess
  EXPECT_LT(solver.solve(Vector{2, 1, 1, 2}, Vector{-1, -1}, impulse).residual, 1e-15);
  expect_near(impulse, {1.0 / 3, 1.0 / 3}, 1e-16);
  EXPECT_THROW(solver.solve(Vector(9), Vector(3), impulse), std::invalid_argument);
}

TEST(Lcp, ResidualMeasuresPullClosingAndImpulseOnOpenGaps) {
  const Vector h{2, 0, 0, 4}, b{-1, 2};
  EXPECT_EQ(complementarity_residual(h, b, Vector{0.5, 0}), 0);
  EXPECT_EQ(complementarity_residual(h, b, Vector{0, 0}), 0.5);       // closes at 1, scale 2
  EXPECT_EQ(complementarity_residual(h, b, Vector{0.5, -1}), 2);      // pulls
  EXPECT_EQ(complementarity_residual(h, b, Vector{0.5, 0.25}), 0.5);  // pushes an open gap
  EXPECT_TRUE(std::isinf(complementarity_residual(h, b, Vector{NAN, 0})));
}

/// Random constraints of any rank, with repeated, opposite, combined and empty rows.
Collision random_collision(std::mt19937& generator) {
  const auto uniform = [&](double low, double high) {  // the same numbers from every library
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  const auto rows = static_cast<std::size_t>(uniform(1, 30));
  const auto dofs = static_cast<std::size_t>(1 + uniform(0.3, 2.5) * static_cast<double>(rows));
  const double density = uniform(0.05, 1), spread = uniform(0, 4);
  std::vector<Vector> l(rows, Vector(dofs));
  for (std::size_t i = 0; i < rows; ++i) {
    const double kind = uniform(0, 1);
    const Vector& other = l[static_cast<std::size_t>(uniform(0, static_cast<double>(i)))];
    const double factor = kind < 0.05 ? 1 : kind < 0.1 ? -1 : kind < 0.15 ? 0.5 : 0;
    for (std::size_t k = 0; k < dofs; ++k) {
      const double fresh = uniform(0, 1) < density ? uniform(-1, 1) : 0;
      l[i][k] = i > 0 && kind < 0.18 ? factor * other[k] : fresh;
    }
  }
  Vector mass, velocity;
  for (std::size_t k = 0; k < dofs; ++k) {
    mass.push_back(std::pow(10, uniform(-spread / 2, spread / 2)));
    velocity.push_back(uniform(0, 1) < 0.1 ? 0 : uniform(-1, 1));
  }
  return {l, mass, velocity};
}

TEST(Lcp, RandomCollisionsOfAnyRankAreComplementary) {
  std::mt19937 generator(20220113);
  int coupled = 0, dependent = 0;
  for (int trial = 0; trial < 2000 && !testing::Test::HasFailure(); ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Collision collision = random_collision(generator);
    const Outcome out = collide(collision);
    expect_complementary(collision, out);
    coupled += out.result.method == LcpMethod::active_set;
    dependent += out.result.dependent_rows > 0;
  }
  EXPECT_GT(coupled, 1000);
  EXPECT_GT(dependent, 100);
}

TEST(Lcp, SameBitsAgainAndScaledBitsUnderPowersOfTwo) {
  std::mt19937 generator(7);
  for (int trial = 0; trial < 300; ++trial) {
    const Collision collision = random_collision(generator);
    Vector h = collision.delassus(), b = collision.gap_rate(collision.free_velocity);
    const Vector guess(collision.rows, trial % 2 == 0 ? 0.0 : 0.3);
    LcpSolver solver(30);
    Vector impulse = guess, again = guess, scaled = guess;
    solver.solve(h, b, impulse);
    solver.solve(h, b, again);
    EXPECT_EQ(impulse, again);
    for (double& value : h) value *= 0x1p-7;
    for (double& value : b) value *= 0x1p10;
    for (double& value : scaled) value *= 0x1p17;
    solver.solve(h, b, scaled);
    for (double& value : impulse) value *= 0x1p17;
    EXPECT_EQ(impulse, scaled) << "trial " << trial;
  }
}

TEST(Lcp, SubnormalGapRatesGiveTheImpulsesOfTheScaledProblem) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Collision collision = random_collision(generator);
    const Vector h = collision.delassus();
    Vector b = collision.gap_rate(collision.free_velocity);
    for (double& value : b) value = std::round(1000 * value);
    LcpSolver solver(30);
    Vector impulse(collision.rows), tiny(collision.rows);
    const LcpResult expected = solver.solve(h, b, impulse);
    for (double& value : b) value = std::scalbn(value, -1074);
    const LcpResult result = solver.solve(h, b, tiny);
    EXPECT_EQ(result.method, expected.method) << "trial " << trial;
    EXPECT_EQ(result.iterations, expected.iterations) << "trial " << trial;
    for (double& value : impulse) value = std::scalbn(value, -1074);
    EXPECT_EQ(tiny, impulse) << "trial " << trial;
  }
}

TEST(Lcp, TheGuessDoesNotChangeVelocities) {
  std::mt19937 generator(11);
  for (int trial = 0; trial < 300; ++trial) {
    const Collision collision = random_collision(generator);
    const Vector h = collision.delassus(), b = collision.gap_rate(collision.free_velocity);
    LcpSolver solver(30);
    Vector cold(collision.rows), warm(collision.rows, 2.0);
    solver.solve(h, b, cold);
    solver.solve(h, b, warm);
    Vector cold_velocity = collision.free_velocity, warm_velocity = collision.free_velocity;
    collision.apply(cold, cold_velocity);
    collision.apply(warm, warm_velocity);
    expect_near(warm_velocity, cold_velocity, 1e-9 * std::max(1.0, largest(cold_velocity)));
  }
}

TEST(Lcp, LargeCollisionsAreComplementary) {
  std::mt19937 generator(11);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  for (const auto& [rows, dofs, filled] :
       {std::tuple<std::size_t, std::size_t, double>{50, 100, 0.04},
        {120, 70, 1.0},
        {81, 117, 0.05}}) {
    SCOPED_TRACE(rows);
    std::vector<Vector> l(rows, Vector(dofs));
    for (Vector& row : l)
      for (double& value : row)
        if (uniform(0, 1) < filled) value = uniform(-1, 1);
    Vector mass, velocity;
    for (std::size_t k = 0; k < dofs; ++k) {
      mass.push_back(uniform(0.5, 2));
      velocity.push_back(uniform(-1, 1));
    }
    const Collision collision(l, mass, velocity);
    expect_complementary(collision, collide(collision));
  }
}

TEST(Lcp, ReferenceProblemsGiveTheReferenceVelocities) {
  const nlohmann::json references = read_collisions();
  EXPECT_EQ(references["collisions"].size(), 27U);
  for (const auto& entry : references["collisions"]) {
    SCOPED_TRACE(entry["name"].get<std::string>());
    const Collision collision = collision_of(entry);
    const Outcome out = collide(collision);
    expect_complementary(collision, out);
    expect_near(out.velocity, entry["after"].get<Vector>(),
                1e-9 * largest(collision.free_velocity));
  }
}

TEST(Lcp, ReferenceClosedGapsAndTowersGiveUniqueNodalImpulses) {
  const nlohmann::json references = read_collisions();
  for (const auto& entry : references["singular"]) {
    SCOPED_TRACE(entry["name"].get<std::string>());
    const Collision collision = collision_of(entry);
    const Outcome out = collide(collision);
    expect_complementary(collision, out);
    const auto nodal = entry["nodal_impulse"].get<Vector>();
    expect_near(out.velocity, entry["after"].get<Vector>(), 1e-12);
    expect_near(collision.nodal_impulse(out.impulse), nodal, 1e-12 * std::max(1.0, largest(nodal)));
  }
  for (const auto& entry : references["towers"]) {
    const auto mass = entry["masses"].get<Vector>();
    const Outcome out = collide(tower(mass, 9.81 * entry["step"].get<double>()));
    const auto exact = entry["impulse"].get<Vector>();
    for (std::size_t k = 0; k < exact.size(); ++k) {
      EXPECT_NEAR(out.impulse[k], exact[k], 1e-13 * exact[k]) << "ratio " << entry["ratio"];
    }
  }
}

}  // namespace lcp_test
}  // namespace pounding::interactions
