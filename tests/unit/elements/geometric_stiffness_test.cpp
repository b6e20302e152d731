#include "elements/geometric_stiffness.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "elements/element_traits.h"

namespace pounding {
namespace geometric_stiffness_test {

constexpr double force = 7;

ElementProperties pipe() {
  return {.young = 3e10, .area = 0.02, .z_axis = {0.3, -0.2, 1}};
}

/// A segment of 3 m that lies aslant, and two unit vectors across it.
constexpr std::array<double, 6> ends{1, 2, 3, 2, 4, 5};
constexpr Vector3 along{1. / 3, 2. / 3, 2. / 3};
constexpr Vector3 across{2. / 3, 1. / 3, -2. / 3};

double work(ElementType type, std::span<const double> motion) {
  const std::size_t size = element_layout(type).size();
  std::vector<double> matrix(size * size, 0.0);
  add_geometric_stiffness(type, ends, pipe(), force, matrix);
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      EXPECT_NEAR(matrix[i * size + j], matrix[j * size + i], 1e-14);
      sum += motion[i] * matrix[i * size + j] * motion[j];
    }
  }
  return sum;
}

TEST(GeometricStiffness, AxialForceIsThatOfTheElongation) {
  EXPECT_TRUE(has_axial_force(ElementType::beam));
  EXPECT_TRUE(has_axial_force(ElementType::bar));
  EXPECT_FALSE(has_axial_force(ElementType::tension_bar));
  EXPECT_FALSE(has_axial_force(ElementType::shell4));
  std::array<double, 6> u{0.1, 0.2, 0.3, 0.1, 0.2, 0.3};
  EXPECT_NEAR(axial_force(ends, pipe(), u), 0, 1e-6);
  for (std::size_t d = 0; d < 3; ++d) u[3 + d] += 1e-3 * along[d] + 0.5 * across[d];
  EXPECT_NEAR(axial_force(ends, pipe(), u), 3e10 * 0.02 / 3 * 1e-3, 1e-3);
}

TEST(GeometricStiffness, ARotationOfThetaTakesForceLengthThetaSquared) {
  const double theta = 0.1;
  std::array<double, 6> bar{};
  std::array<double, 12> beam{};
  const Vector3 axis{along[1] * across[2] - along[2] * across[1],
                     along[2] * across[0] - along[0] * across[2],
                     along[0] * across[1] - along[1] * across[0]};
  for (std::size_t d = 0; d < 3; ++d) {
    bar[3 + d] = beam[6 + d] = 3 * theta * across[d];
    beam[3 + d] = beam[9 + d] = theta * axis[d];
  }
  const double exact = force * 3 * theta * theta;
  EXPECT_NEAR(work(ElementType::bar, bar), exact, 1e-12);
  EXPECT_NEAR(work(ElementType::beam, beam), exact, 1e-12);
}

TEST(GeometricStiffness, ABentBeamTakesTheIntegralOfItsSlopeSquared) {
  const Vector3 axis{along[1] * across[2] - along[2] * across[1],
                     along[2] * across[0] - along[0] * across[2],
                     along[0] * across[1] - along[1] * across[0]};
  std::array<double, 12> beam{};
  for (std::size_t d = 0; d < 3; ++d) {
    beam[3 + d] = axis[d];  // slopes 1 and -1: w = x - x^2 / L
    beam[9 + d] = -axis[d];
  }
  EXPECT_NEAR(work(ElementType::beam, beam), force * 3.0 / 3, 1e-12);
}

TEST(GeometricStiffness, StretchTranslationAndTwistTakeNothing) {
  std::array<double, 12> beam{};
  std::array<double, 6> bar{};
  for (std::size_t d = 0; d < 3; ++d) {
    bar[d] = 0.2 * across[d];
    bar[3 + d] = bar[d] + 0.01 * along[d];
    beam[d] = bar[d];
    beam[6 + d] = bar[3 + d];
    beam[3 + d] = 0.3 * along[d];
  }
  EXPECT_NEAR(work(ElementType::bar, bar), 0, 1e-14);
  EXPECT_NEAR(work(ElementType::beam, beam), 0, 1e-14);
}

/// The tip of a column buckles at P_e / (1 + P_e / (G A_s)), F. Engesser, 1889: det(K + N G) = 0.
TEST(GeometricStiffness, AColumnFlexibleInShearBucklesAtEngessersLoad) {
  ElementProperties p = pipe();
  p.z_axis = {0, 0, 1};
  p.poisson = 0.2;
  p.inertia_y = p.inertia_z = 2e-3;
  p.torsion = 4e-3;
  p.shear_area_y = p.shear_area_z = 0.002;
  constexpr std::size_t count = 12;
  constexpr double length = 3;
  constexpr double pi = 3.14159265358979323846;
  const double euler = pi * pi * p.young * p.inertia_y / (4 * length * length);
  const double shear = p.young / (2 * (1 + p.poisson)) * p.shear_area_z;
  const double expected = euler / (1 + euler / shear);
  EXPECT_LT(expected, 0.8 * euler);
  // Signs of the pivots in the plane x-z: all of them positive below the load.
  const auto stands = [&](double load) {
    const std::size_t size = 2 * count;
    std::vector<double> matrix(size * size, 0.0);
    for (std::size_t e = 0; e < count; ++e) {
      const double h = length / count;
      const std::array<double, 6> x{h * static_cast<double>(e),     0, 0,
                                    h * static_cast<double>(e + 1), 0, 0};
      std::vector<double> k(144);
      std::vector<double> mass(12);
      element_matrices(ElementType::beam, x, p, k, mass);
      add_geometric_stiffness(ElementType::beam, x, p, -load, k);
      const std::array<std::size_t, 4> local{2, 4, 8, 10};
      for (std::size_t i = e == 0 ? 2 : 0; i < 4; ++i) {
        for (std::size_t j = e == 0 ? 2 : 0; j < 4; ++j) {
          matrix[(2 * e + i - 2) * size + 2 * e + j - 2] += k[12 * local[i] + local[j]];
        }
      }
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (!(matrix[i * size + i] > 0)) return false;
      for (std::size_t r = i + 1; r < size; ++r) {
        const double factor = matrix[r * size + i] / matrix[i * size + i];
        for (std::size_t c = i; c < size; ++c)
          matrix[r * size + c] -= factor * matrix[i * size + c];
      }
    }
    return true;
  };
  EXPECT_TRUE(stands(0.9999 * expected));
  EXPECT_FALSE(stands(1.0005 * expected));
}

}  // namespace geometric_stiffness_test
}  // namespace pounding
