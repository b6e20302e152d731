#include "solvers/friction_solver.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "solvers/friction_point.h"
#include "support/full_rows.h"

namespace pounding::interactions {
namespace friction_solver_test {

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

/// A wall of bricks of 1 m x 0.5 m x 0.5 m in running bond, or a pyramid of them, each on the ground
/// or on two others, at the corners of what they have in common; a step of gravity, in which each
/// moves at random speeds [m/s, rad/s].
class Wall {
 public:
  enum class Shape { wall, pyramid };
  Wall(Shape shape, int rows, int columns, double friction, double speed, unsigned seed = 1)
      : shape_(shape), columns_(columns) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        Motion& v = velocity_.emplace_back(Motion{0, 0, -9.81e-4, 0, 0, 0});
        for (double& value : v) value += speed * normal(random);
        if (column < bricks_of(row)) stand(row, column);
      }
    }
    coefficient_.assign(points_.size(), friction);
    for (std::size_t i = 0; i < points_.size(); ++i) add_rows(i);
  }
  FrictionProblem problem() const { return {delassus_, rate_, coefficient_}; }
  std::size_t points() const { return points_.size(); }

 private:
  using Motion = std::array<double, 6>;
  struct Point {
    std::array<int, 2> brick;  ///< below, -1: the ground; and above
    std::array<double, 3> place;
  };
  double middle(int brick) const {
    const int row = brick / columns_;
    return brick % columns_ + 0.5 * (shape_ == Shape::wall ? row % 2 : row);
  }
  int bricks_of(int row) const { return shape_ == Shape::wall ? columns_ : columns_ - row; }
  void stand(int row, int column) {
    const int above = row * columns_ + column;
    const double x = middle(above);
    const auto add = [&](int below, double from, double to) {
      for (const double end : {from, to}) {
        for (const double y : {-0.25, 0.25})
          points_.push_back({{below, above}, {end, y, 0.5 * row}});
      }
    };
    if (row == 0) add(-1, x - 0.5, x + 0.5);
    const int right = shape_ == Shape::wall ? row % 2 : 1;
    for (const int beside : {right - 1, right}) {
      const int below = above - columns_ + beside;
      if (row == 0 || column + beside < 0 || column + beside >= bricks_of(row - 1)) continue;
      add(below, std::max(x, middle(below)) - 0.5, std::min(x, middle(below)) + 0.5);
    }
  }
  /// Motion of a brick that one of the three rates of a point tells: z, x, y.
  Motion row_of(const Point& point, std::size_t side, std::size_t direction) const {
    const int brick = point.brick[side];
    const std::size_t axis = (direction + 2) % 3;
    const std::array<double, 3> arm{point.place[0] - middle(brick), point.place[1],
                                    point.place[2] - 0.5 * (brick / columns_ + 0.5)};
    Motion motion{};
    const double sign = side == 0 ? -1 : 1;
    motion[axis] = sign;
    motion[3 + (axis + 1) % 3] = sign * arm[(axis + 2) % 3];
    motion[3 + (axis + 2) % 3] = -sign * arm[(axis + 1) % 3];
    return motion;
  }
  void add_rows(std::size_t i) {
    constexpr double mass = 500;
    constexpr Motion inverse{1 / mass, 1 / mass, 1 / mass, 24 / mass, 9.6 / mass, 9.6 / mass};
    for (std::size_t d = 0; d < 3; ++d) {
      double& rate = rate_.emplace_back(0.0);
      for (std::size_t side = 0; side < 2; ++side) {
        if (points_[i].brick[side] < 0) continue;
        const Motion row = row_of(points_[i], side, d);
        const Motion& v = velocity_[static_cast<std::size_t>(points_[i].brick[side])];
        for (std::size_t k = 0; k < row.size(); ++k) rate += row[k] * v[k];
      }
      for (std::size_t j = 0; j < points_.size(); ++j) {
        for (std::size_t e = 0; e < 3; ++e) add_entry(i, d, j, e, inverse);
      }
      delassus_.end_row();
    }
  }
  void add_entry(std::size_t i, std::size_t d, std::size_t j, std::size_t e,
                 const Motion& inverse) {
    double sum = 0;
    bool feel = false;
    for (std::size_t a = 0; a < 2; ++a) {
      for (std::size_t b = 0; b < 2; ++b) {
        if (points_[i].brick[a] < 0 || points_[i].brick[a] != points_[j].brick[b]) continue;
        feel = true;
        const Motion one = row_of(points_[i], a, d);
        const Motion other = row_of(points_[j], b, e);
        for (std::size_t k = 0; k < one.size(); ++k) sum += one[k] * inverse[k] * other[k];
      }
    }
    if (feel) delassus_.add(static_cast<int>(3 * j + e), sum);
  }

  Shape shape_;
  int columns_;
  std::vector<Motion> velocity_;
  std::vector<Point> points_;
  std::vector<double> rate_;
  std::vector<double> coefficient_;
  SparseRows delassus_;
};

void expect_solved(const Wall& wall, double most) {
  ASSERT_GT(wall.points(), 300U);
  std::vector<double> impulse(3 * wall.points(), 0.0);
  FrictionSolver solver(wall.points());
  const FrictionResult result = solver.solve(wall.problem(), impulse);
  EXPECT_LT(result.residual, most);
  EXPECT_EQ(result.residual, friction_residual(wall.problem(), impulse));
}

TEST(FrictionSolver, SolvesPilesOfManyBlocks) {
  for (const double friction : {0.3, 0.6}) {
    SCOPED_TRACE(friction);
    expect_solved(Wall(Wall::Shape::wall, 7, 7, friction, 1e-5), 1e-10);
    expect_solved(Wall(Wall::Shape::pyramid, 10, 10, friction, 1e-5), 1e-10);
  }
}

TEST(FrictionSolver, SolvesPilesThatAreThrownAbout) {
  for (const unsigned seed : {1U, 4U}) {
    SCOPED_TRACE(seed);
    expect_solved(Wall(Wall::Shape::wall, 7, 7, 0.8, 0.1, seed), 1e-9);
    expect_solved(Wall(Wall::Shape::pyramid, 10, 10, 0.8, 0.1, seed), 1e-9);
  }
}

}  // namespace friction_solver_test
}  // namespace pounding::interactions
