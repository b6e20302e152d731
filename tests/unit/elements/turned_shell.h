#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shell_model.h"

/// Shells moved and turned in space.
namespace pounding::testing_support {

/// Rotation by 30, 40 and 50 degrees about x, y, z in turn.
inline Matrix3 some_rotation() {
  const auto about = [](std::size_t axis, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180);
    const double s = std::sin(degrees * std::numbers::pi / 180);
    Matrix3 r{};
    const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
    r[axis][axis] = 1;
    r[j][j] = r[k][k] = c;
    r[j][k] = -s;
    r[k][j] = s;
    return r;
  };
  const auto product = [](const Matrix3& a, const Matrix3& b) {
    Matrix3 r{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
    return r;
  };
  return product(about(2, 50), product(about(1, 40), about(0, 30)));
}

/// Every triple of `values` turned by some_rotation().
inline std::vector<double> turned(const std::vector<double>& values) {
  const Matrix3 r = some_rotation();
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    const Vector3 v = pounding::multiply(r, Vector3{values[i], values[i + 1], values[i + 2]});
    result.insert(result.end(), v.begin(), v.end());
  }
  return result;
}

/// Turning the nodes turns the forces: K_turned (R u) = R (K u), for one displacement per dof.
inline void expect_turns_with_nodes(const std::vector<double>& x, const ShellProperties& p) {
  const auto e = dense_shell(x, p), f = dense_shell(turned(x), p);
  double scale = 0;
  for (const double k : e.stiffness) scale = std::max(scale, std::abs(k));
  for (std::size_t i = 0; i < e.lumped_mass.size(); ++i) {
    std::vector<double> u(e.lumped_mass.size(), 0.0);
    u[i] = 1;
    const auto expected = turned(multiply(e.stiffness, u));
    const auto force = multiply(f.stiffness, turned(u));
    for (std::size_t j = 0; j < u.size(); ++j) EXPECT_NEAR(force[j], expected[j], 1e-13 * scale);
    EXPECT_NEAR(f.lumped_mass[i] / e.lumped_mass[i], 1, 1e-13);
  }
}

/// Six rigid motions cost no force, and every other motion costs energy.
inline void expect_six_rigid_modes(const std::vector<double>& x,
                                   const std::vector<double>& stiffness) {
  const std::size_t nodes = x.size() / 3;
  const auto values = symmetric_eigenvalues(stiffness, 6 * nodes);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(values[i], 0, 1e-13 * values.back()) << i;
  EXPECT_GT(values[6], 1e-7 * values.back());
  for (std::size_t mode = 0; mode < 6; ++mode) {
    std::vector<double> u(6 * nodes, 0.0);
    for (std::size_t node = 0; node < nodes; ++node) {
      Vector3 axis{}, move{};
      (mode < 3 ? move : axis)[mode % 3] = 1;
      const Vector3 swing = cross(axis, {x[3 * node], x[3 * node + 1], x[3 * node + 2]});
      for (std::size_t i = 0; i < 3; ++i) {
        u[6 * node + i] = move[i] + swing[i];
        u[6 * node + 3 + i] = axis[i];
      }
    }
    for (const double f : multiply(stiffness, u)) EXPECT_NEAR(f, 0, 1e-13 * values.back()) << mode;
  }
}

}  // namespace pounding::testing_support
