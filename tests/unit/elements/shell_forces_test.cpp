#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "elements/force_rows.h"
#include "shell_model.h"
#include "turned_shell.h"

namespace pounding {
namespace shell_forces_test {

using testing_support::dense_shell;
using testing_support::inner;

const std::vector<double> quad{0, 0, 0, 1.1, 0.1, 0, 0.9, 0.8, 0, -0.1, 0.6, 0};
const std::vector<double> rectangle{0, 0, 0, 1.1, 0, 0, 1.1, 0.7, 0, 0, 0.7, 0};
const std::vector<double> triangle{0, 0, 0, 1.1, 0.1, 0, 0.3, 0.8, 0};

constexpr double young = 30e9, poisson = 0.2, thickness = 0.2;

ElementProperties concrete() {
  return {.young = young, .poisson = poisson, .thickness = thickness};
}

std::vector<double> rows_of(const std::vector<double>& x) {
  return shell_force_rows(x.size() == 9 ? ElementType::shell3 : ElementType::shell4, x, concrete());
}

using Forces = std::array<double, 8>;

Forces forces_of(const std::vector<double>& x, const std::vector<double>& u) {
  const std::vector<double> rows = rows_of(x);
  Forces forces{};
  for (std::size_t k = 0; k < forces.size(); ++k) {
    for (std::size_t i = 0; i < u.size(); ++i) forces[k] += rows[k * u.size() + i] * u[i];
  }
  return forces;
}

/// Six components at every node, from its place.
std::vector<double> field(const std::vector<double>& x,
                          const std::function<std::array<double, 6>(double, double)>& at) {
  std::vector<double> u;
  for (std::size_t i = 0; i < x.size(); i += 3) {
    const auto here = at(x[i], x[i + 1]);
    u.insert(u.end(), here.begin(), here.end());
  }
  return u;
}

/// Plane stress times the thickness: exx 1e-3, eyy 2e-3, gxy 3e-3.
std::vector<double> stretched(const std::vector<double>& x) {
  return field(x, [](double a, double b) {
    return std::array<double, 6>{1e-3 * a + 1e-3 * b, 2e-3 * a + 2e-3 * b, 0, 0, 0, 0};
  });
}

/// w = 1e-3 (a^2 / 2 + 2 b^2 / 2 + 3 a b) and the rotations (dw/dy, -dw/dx) of its normals, so that
/// the face at positive z is compressed.
std::vector<double> bent(const std::vector<double>& x) {
  return field(x, [](double a, double b) {
    return std::array<double, 6>{
        0, 0, 1e-3 * (a * a / 2 + b * b + 3 * a * b), 1e-3 * (2 * b + 3 * a), -1e-3 * (a + 3 * b),
        0};
  });
}

void expect_forces(const Forces& found, const Forces& expected) {
  double scale = 0;
  for (const double value : expected) scale = std::max(scale, std::abs(value));
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k], expected[k], 1e-12 * scale) << shell_force_names[k];
  }
}

constexpr double plane = young / (1 - poisson * poisson);
constexpr double slip = young / (2 * (1 + poisson));

TEST(ShellForces, UniformStrainsHaveTheirClosedForm) {
  const double bending = thickness * thickness * thickness / 12;
  for (const auto& x : {quad, rectangle, triangle}) {
    expect_forces(forces_of(x, stretched(x)), {thickness * plane * (1e-3 + poisson * 2e-3),
                                               thickness * plane * (2e-3 + poisson * 1e-3),
                                               thickness * slip * 3e-3, 0, 0, 0, 0, 0});
    expect_forces(forces_of(x, bent(x)),
                  {0, 0, 0, -bending * plane * (1e-3 + poisson * 2e-3),
                   -bending * plane * (2e-3 + poisson * 1e-3), -bending * slip * 6e-3, 0, 0});
  }
  const auto sheared = field(rectangle, [](double a, double b) {
    return std::array<double, 6>{0, 0, 1e-3 * a + 2e-3 * b, 0, 0, 0};
  });
  const double modulus = 5.0 / 6 * slip * thickness;
  expect_forces(forces_of(rectangle, sheared), {0, 0, 0, 0, 0, 0, 1e-3 * modulus, 2e-3 * modulus});
}

TEST(ShellForces, DoNotKnowTheOrderOfTheNodes) {
  for (const auto& x : {quad, triangle}) {
    const auto u = bent(x), v = stretched(x);
    std::vector<double> mirrored, moved;
    for (std::size_t node = x.size() / 3; node-- > 0;) {
      mirrored.insert(mirrored.end(), &x[3 * node], &x[3 * node] + 3);
      for (std::size_t c = 0; c < 6; ++c) moved.push_back(u[6 * node + c] + v[6 * node + c]);
    }
    std::vector<double> both(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) both[i] = u[i] + v[i];
    expect_forces(forces_of(mirrored, moved), forces_of(x, both));
  }
}

/// Whether u0' K u is the area times the product of the strains of u0 with the forces of u, as it
/// must be where the strains of u0 are uniform: the forces are means over the element then.
void expect_work(const std::vector<double>& x, const std::vector<double>& uniform, double area,
                 const Forces& strains) {
  ShellProperties shell{young, poisson, 0, thickness};
  const auto element = dense_shell(x, shell);
  for (std::size_t i = 0; i < uniform.size(); ++i) {
    std::vector<double> u(uniform.size(), 0.0);
    u[i] = 1;
    const double work = inner(uniform, testing_support::multiply(element.stiffness, u));
    const Forces forces = forces_of(x, u);
    double expected = 0;
    for (std::size_t k = 0; k < forces.size(); ++k) expected += area * strains[k] * forces[k];
    EXPECT_NEAR(work, expected, 1e-10 * young * thickness * 1e-3) << i;
  }
}

TEST(ShellForces, AreTheMeansThatTheStiffnessHas) {
  const auto half_turn = [](std::vector<double> u) {  // rz follows the turn of the plane
    for (std::size_t i = 5; i < u.size(); i += 6) u[i] = (2e-3 - 1e-3) / 2;
    return u;
  };
  const double areas[]{0.705, 0.77, 0.425};
  const std::vector<double>* shapes[]{&quad, &rectangle, &triangle};
  for (std::size_t s = 0; s < 3; ++s) {
    const std::vector<double>& x = *shapes[s];
    expect_work(x, half_turn(stretched(x)), areas[s], {1e-3, 2e-3, 3e-3, 0, 0, 0, 0, 0});
    expect_work(x, bent(x), areas[s], {0, 0, 0, -1e-3, -2e-3, -6e-3, 0, 0});
  }
  const auto sheared = field(rectangle, [](double a, double b) {
    return std::array<double, 6>{0, 0, 1e-3 * a + 2e-3 * b, 0, 0, 0};
  });
  expect_work(rectangle, sheared, areas[1], {0, 0, 0, 0, 0, 0, 1e-3, 2e-3});
}

/// Coordinates and motions of an element in the x-y plane carried to axes e1, e2, e3.
std::vector<double> carried(const std::vector<double>& values, const Matrix3& axes) {
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      result.push_back(values[i] * axes[0][c] + values[i + 1] * axes[1][c] +
                       values[i + 2] * axes[2][c]);
    }
  }
  return result;
}

TEST(ShellForces, GoWithTheirAxesToAnyPlane) {
  for (const Vector3& direction :
       {Vector3{0, 0, 1}, Vector3{0, 0, -1}, Vector3{0, 1, 0}, Vector3{1, 0, 0}, Vector3{-1, 0, 0},
        Vector3{1, -2, 0.5}, Vector3{0.3, 0.2, -1}, Vector3{-1, 1e-12, 0}}) {
    const Matrix3 axes = shell_force_axes(normalised(direction));
    EXPECT_NEAR(determinant(axes), 1, 1e-14);
    EXPECT_NEAR(std::abs(dot(axes[2], normalised(direction))), 1, 1e-14);
    for (const auto& x : {quad, triangle}) {
      auto u = stretched(x);
      const auto v = bent(x);
      for (std::size_t i = 0; i < u.size(); ++i) u[i] += v[i];
      expect_forces(forces_of(carried(x, axes), carried(u, axes)), forces_of(x, u));
    }
  }
}

void expect_axes(const Vector3& normal, const Matrix3& expected) {
  const Matrix3 axes = shell_force_axes(normal);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(axes[i][c], expected[i][c], 1e-11) << i << c;
  }
}

TEST(ShellForces, AxesOfSlabsAndWalls) {
  for (const double side : {1.0, -1.0}) {
    expect_axes({0, 0, side}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    expect_axes({0, side, 0}, {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}});
    expect_axes({side, 0, 0}, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}});
    expect_axes({side, 1e-12, 0}, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}});
    expect_axes({0.6 * side, 0.8 * side, 0}, {{{0.8, -0.6, 0}, {0, 0, 1}, {-0.6, -0.8, 0}}});
    expect_axes({0.6 * side, 0, 0.8 * side}, {{{0.8, 0, -0.6}, {0, 1, 0}, {0.6, 0, 0.8}}});
  }
}

TEST(ShellForces, RefuseAnElementThatCannotBe) {
  const std::vector<double> flat{0, 0, 0, 1, 0, 0, 2, 0, 0};
  EXPECT_THROW(rows_of(flat), ElementError);
}

}  // namespace shell_forces_test
}  // namespace pounding
