#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "brick_mesh.h"
#include "elements/solids.h"

namespace pounding {
namespace hex8_test {

using testing_support::box;
using testing_support::dense_element;
using testing_support::inner;
using testing_support::squared_circular_frequencies;

constexpr ElementType both_formulations[] = {ElementType::hex8_full, ElementType::hex8};

ElementProperties concrete(double poisson = 0.2) {
  return {.young = 30e9, .poisson = poisson, .density = 2400};
}

double lame(const ElementProperties& p) {
  return p.young * p.poisson / ((1 + p.poisson) * (1 - 2 * p.poisson));
}

double shear_modulus(const ElementProperties& p) {
  return p.young / (2 * (1 + p.poisson));
}

/// omega of the three uniform-strain modes of a free brick of edges h with row-sum mass: nodes move
/// by e_i x_i, the nodal force is sigma_i V / (4 h_i), so omega^2 e_i = 4 sigma_i / (rho h_i^2).
std::vector<double> uniform_strain_modes(const ElementProperties& p, const Vector3& h) {
  std::vector<double> matrix(9);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      matrix[3 * i + j] =
          4 / p.density / (h[i] * h[j]) * (lame(p) + (i == j ? 2 * shear_modulus(p) : 0.0));
  return testing_support::symmetric_eigenvalues(matrix, 3);
}

TEST(Hex8, CubeFrequenciesHaveTheirClosedForm) {
  for (const ElementType type : both_formulations) {
    for (const double poisson : {0.0, 0.2, 0.3, 0.45}) {
      const ElementProperties p = concrete(poisson);
      const double h = 0.37;
      const auto e = dense_element(type, box(h, h, h), p);
      const auto values = squared_circular_frequencies(e.stiffness, e.lumped_mass);
      const double dilatation = 4 * (3 * lame(p) + 2 * shear_modulus(p)) / (p.density * h * h);
      const double shear = 8 * shear_modulus(p) / (p.density * h * h);
      EXPECT_NEAR(values.back(), dilatation, 1e-12 * dilatation);
      // Two deviatoric and three shear modes of uniform strain.
      int found = 0;
      for (const double value : values)
        if (std::abs(value - shear) < 1e-12 * dilatation) ++found;
      EXPECT_GE(found, 5) << "poisson " << poisson;
    }
  }
}

TEST(Hex8, BrickLargestFrequencyIsUniformStrain) {
  struct Row {
    Vector3 edges;
    double poisson;
    double omega;
  };
  const Row rows[] = {{{1, 1, 1}, 0.2, 9128.70929},          {{1, 1, 1}, 0.3, 11180.3399},
                      {{0.12, 0.12, 0.22}, 0.2, 70480.1678}, {{0.12, 0.12, 0.22}, 0.3, 84237.0413},
                      {{1, 1, 0.05}, 0.2, 149094.555},       {{1, 1, 0.05}, 0.3, 164158.058},
                      {{1, 1, 0.1}, 0.2, 74582.7},           {{1, 1, 0.01}, 0.2, 745361},
                      {{1, 1, 0.0001}, 0.2, 7.45356e7}};
  for (const ElementType type : both_formulations) {
    for (const Row& row : rows) {
      const ElementProperties p = concrete(row.poisson);
      const auto e = dense_element(type, box(row.edges[0], row.edges[1], row.edges[2]), p);
      const double omega =
          std::sqrt(squared_circular_frequencies(e.stiffness, e.lumped_mass).back());
      const double closed = std::sqrt(uniform_strain_modes(p, row.edges).back());
      EXPECT_NEAR(omega / closed, 1, 1e-12);
      EXPECT_NEAR(omega / row.omega, 1, 1e-6);
    }
  }
}

TEST(Hex8, QuarterTurnPermutesTheStiffness) {
  // Turned about z: (x, y, z) -> (-y, x, z), the nodes keeping their numbers.
  const auto x = box(0.12, 0.2, 0.22);
  auto y = x;
  for (std::size_t a = 0; a < 24; a += 3) {
    y[a] = -x[a + 1];
    y[a + 1] = x[a];
  }
  const std::size_t source[3] = {1, 0, 2};
  const double sign[3] = {-1, 1, 1};
  for (const ElementType type : both_formulations) {
    const auto e = dense_element(type, x, concrete());
    const auto f = dense_element(type, y, concrete());
    for (std::size_t i = 0; i < 24; ++i)
      for (std::size_t j = 0; j < 24; ++j) {
        const std::size_t from = (i - i % 3 + source[i % 3]) * 24 + j - j % 3 + source[j % 3];
        EXPECT_NEAR(f.stiffness[i * 24 + j], sign[i % 3] * sign[j % 3] * e.stiffness[from],
                    1e-14 * 30e9);
      }
  }
}

TEST(Hex8, RenumberingTheNodesPermutesTheStiffness) {
  // The same distorted brick seen from another corner, and lying on another face.
  const auto x = [] {
    auto nodes = box(1, 0.8, 0.6);
    nodes[0] -= 0.1;
    nodes[7] += 0.12;
    nodes[20] += 0.15;
    nodes[21] -= 0.05;
    return nodes;
  }();
  const std::array<std::size_t, 8> orders[] = {{1, 2, 3, 0, 5, 6, 7, 4}, {0, 4, 5, 1, 3, 7, 6, 2}};
  for (const ElementType type : both_formulations) {
    const auto e = dense_element(type, x, concrete());
    for (const auto& order : orders) {
      std::vector<double> y(24);
      for (std::size_t a = 0; a < 24; ++a) y[a] = x[3 * order[a / 3] + a % 3];
      const auto f = dense_element(type, y, concrete());
      for (std::size_t i = 0; i < 24; ++i) {
        const std::size_t row = 3 * order[i / 3] + i % 3;
        EXPECT_NEAR(f.lumped_mass[i], e.lumped_mass[row], 1e-12);
        for (std::size_t j = 0; j < 24; ++j)
          EXPECT_NEAR(f.stiffness[i * 24 + j], e.stiffness[row * 24 + 3 * order[j / 3] + j % 3],
                      1e-13 * 30e9);
      }
    }
  }
}

TEST(Hex8, IncompatibleModesBendABrickExactly) {
  // Pure bending of a centred brick, u = (k x z, -nu k y z, const at the corners): the modes supply
  // the parabolas, so the energy is E k^2 I L / 2. Trilinear bricks are far stiffer.
  const double a = 0.5, b = 0.3, c = 0.2, k = 1e-3;
  for (const double poisson : {0.0, 0.2, 0.4}) {
    const ElementProperties p = concrete(poisson);
    const auto x = box(a, b, c);
    std::vector<double> u(24, 0.0);
    for (std::size_t n = 0; n < 24; n += 3) {
      u[n] = k * (x[n] - a / 2) * (x[n + 2] - c / 2);
      u[n + 1] = -poisson * k * (x[n + 1] - b / 2) * (x[n + 2] - c / 2);
    }
    const double exact = 0.5 * p.young * k * k * b * c * c * c / 12 * a;
    const auto energy = [&](ElementType type) {
      return 0.5 * inner(u, testing_support::multiply(dense_element(type, x, p).stiffness, u));
    };
    EXPECT_NEAR(energy(ElementType::hex8) / exact, 1, 1e-12);
    EXPECT_GT(energy(ElementType::hex8_full) / exact, 3);
  }
}

TEST(Hex8, IncompatibleModesOnlySoften) {
  auto x = box(1, 0.8, 0.6);
  x[7] += 0.12;
  x[20] += 0.15;
  const auto full = dense_element(ElementType::hex8_full, x, concrete()).stiffness;
  auto difference = full;
  const auto soft = dense_element(ElementType::hex8, x, concrete()).stiffness;
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= soft[i];
  const auto values = testing_support::symmetric_eigenvalues(difference, 24);
  EXPECT_GE(values.front(), -1e-12 * values.back());
  EXPECT_GT(values.back(), 0.01 * testing_support::symmetric_eigenvalues(full, 24).back());
}

TEST(Hex8, MassIsTheShareOfVolume) {
  const auto brick = dense_element(ElementType::hex8, box(0.12, 0.2, 0.22), concrete());
  for (const double m : brick.lumped_mass) EXPECT_NEAR(m, 2400 * 0.12 * 0.2 * 0.22 / 8, 1e-14);
  // A frustum of square sections 2 and 1 and height 1: volume 7/3, symmetric nodes alike. The
  // section is (2 - z)^2, so the four upper nodes take the integral of z (2 - z)^2 = 11/12.
  const auto frustum = dense_element(
      ElementType::hex8,
      {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -.5, -.5, 1, .5, -.5, 1, .5, .5, 1, -.5, .5, 1},
      concrete());
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(frustum.lumped_mass[i], 2400 * (7.0 / 3 - 11.0 / 12) / 4, 1e-9);
    EXPECT_NEAR(frustum.lumped_mass[12 + i], 2400 * (11.0 / 12) / 4, 1e-9);
  }
}

}  // namespace hex8_test
}  // namespace pounding
