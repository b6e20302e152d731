// Hexahedra whose numbers have 32 bits: one operator, however it is applied, and close to the exact one.

#include "stiffness/strains/single_hexahedron.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/matrix3.h"
#include "stiffness/single_stiffness.h"
#include "stiffness/strains/strain_elements.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t size = SingleHexahedron::size;
using Field = std::array<double, size>;

struct Element {
  std::vector<double> coordinates;
  ElementProperties properties;
  std::vector<double> stiffness;

  explicit Element(std::vector<double> x, double poisson = 0.2, double young = 30e9)
      : coordinates(std::move(x)),
        properties{.young = young, .poisson = poisson, .density = 2400},
        stiffness(in(Numbers::in_double)) {}
  std::vector<double> in(Numbers numbers) const {
    std::vector<double> result(size * size), mass(size);
    element_matrices_in(numbers, ElementType::hex8, coordinates, properties, result, mass);
    return result;
  }
  auto numbers() const { return SingleHexahedron::find(coordinates, stiffness); }
  std::vector<double> rounded() const { return in(Numbers::in_single); }
  double stiffest() const {
    double largest = 0;
    for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, stiffness[i * (size + 1)]);
    return largest;
  }
};

/// Corners of a box of 0.5 x 0.4 x 0.3 m, each moved by up to `out`, turned and far from the origin.
std::vector<double> moved_box(std::mt19937& generator, double out) {
  std::uniform_real_distribution<double> moved(-out, out);
  const double c = std::cos(0.7), s = std::sin(0.7);
  std::vector<double> x;
  for (int a = 0; a < 8; ++a) {
    const bool second = a % 4 == 1 || a % 4 == 2;
    const double u = (second ? 0.5 : 0) + moved(generator);
    const double v = (a % 4 >= 2 ? 0.4 : 0) + moved(generator);
    const double w = (a >= 4 ? 0.3 : 0) + moved(generator);
    x.insert(x.end(), {7 + c * u - s * v, s * u + c * v - 3, 11 + w});
  }
  return x;
}

Field multiplied(const std::vector<double>& matrix, const Field& w) {
  Field q{};
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) q[i] += matrix[i * size + j] * w[j];
  }
  return q;
}

double largest(const Field& values) {
  double found = 0;
  for (const double value : values) found = std::max(found, std::abs(value));
  return found;
}

TEST(SingleHexahedron, MatrixAndProductAreOneOperatorCloseToTheExactOne) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> values(-1, 1);
  for (int k = 0; k < 20; ++k) {
    const Element element(moved_box(generator, 0.05));
    const auto numbers = element.numbers();
    ASSERT_TRUE(numbers);
    std::vector<std::array<LocalIndex, 6>> of_node;
    for (LocalIndex a = 0; a < 8; ++a) of_node.push_back({3 * a, 3 * a + 1, 3 * a + 2, -1, -1, -1});
    const StrainElements<SingleHexahedron> product({*numbers}, {{0, {0, 1, 2, 3, 4, 5, 6, 7}}},
                                                   size, of_node);
    Field w{};
    for (double& value : w) value = values(generator);
    std::vector<double> argument(w.begin(), w.end());
    argument.resize(size + 6);
    std::vector<double> found(size + 6);
    product.apply(argument.data(), found.data());
    const std::vector<double> matrix = element.rounded();
    const Field expected = multiplied(matrix, w);
    const Field exact = multiplied(element.stiffness, w);
    double error = 0;
    double rounding = 0;
    for (std::size_t i = 0; i < size; ++i) {
      error = std::max(error, std::abs(found[i] - expected[i]));
      rounding = std::max(rounding, std::abs(exact[i] - expected[i]));
      for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(matrix[i * size + j], matrix[j * size + i]);
    }
    EXPECT_LT(error, 1e-14 * largest(exact));
    EXPECT_LT(rounding, 5e-7 * largest(exact));
    EXPECT_GT(rounding, 1e-9 * largest(exact));
  }
}

/// Translations are exact. Rotations are not: their forces are 24 digits of those of a strain.
TEST(SingleHexahedron, RigidMotionsGiveNextToNothing) {
  std::mt19937 generator(11);
  const Element element(moved_box(generator, 0.05));
  const std::vector<double> matrix = element.rounded();
  for (std::size_t motion = 0; motion < 6; ++motion) {
    Field w{};
    for (std::size_t a = 0; a < 8; ++a) {
      Vector3 axis{}, x{};
      axis[motion % 3] = 1;
      for (std::size_t d = 0; d < 3; ++d) {
        x[d] = element.coordinates[3 * a + d] - element.coordinates[d];
      }
      const Vector3 u = motion < 3 ? axis : cross(axis, x);
      std::copy(u.begin(), u.end(), &w[3 * a]);
    }
    const double part = largest(multiplied(matrix, w)) / (element.stiffest() * largest(w));
    EXPECT_LT(part, motion < 3 ? 1e-14 : 3e-7) << "motion " << motion;
    EXPECT_GE(part, motion < 3 ? 0 : 1e-12) << "motion " << motion;
  }
}

/// A factor on Young's modulus is one on K.
TEST(SingleHexahedron, FactorsOnYoungsModulusAreInTheScale) {
  std::mt19937 generator(13);
  const std::vector<double> x = moved_box(generator, 0.05);
  const auto one = Element(x).numbers();
  const auto other = Element(x, 0.2, 0.937 * 30e9).numbers();
  ASSERT_TRUE(one && other);
  for (std::size_t k = 0; k < SingleHexahedron::scale; ++k) {
    EXPECT_NEAR((*one)[k], (*other)[k], 1e-14) << k;  // those that vanish to round-off differ
  }
  constexpr std::size_t scale = SingleHexahedron::scale;
  const auto sum = [](const auto& numbers) { return double{numbers[scale]} + numbers[scale + 1]; };
  const double expected = 0.937 * sum(*one);
  EXPECT_NEAR(sum(*other), expected, 1e-14 * expected);
}

/// Boxes and extruded ones share their numbers or have few; those whose softest strains are below the
/// digits of the stiffest would lose them.
TEST(SingleHexahedron, OthersKeepTheirNumbers) {
  std::mt19937 generator(17);
  const std::vector<double> moved = moved_box(generator, 0.05);
  std::vector<double> extruded = {0, 0, 0, 1, 0, 0, 1.1, 1, 0, 0, 1.2, 0};
  for (std::size_t i = 0; i < 12; ++i) extruded.push_back(extruded[i] + (i % 3 == 2 ? 0.5 : 0));
  EXPECT_FALSE(may_round(ElementType::hex8, moved_box(generator, 0)));
  EXPECT_FALSE(may_round(ElementType::hex8, extruded));
  EXPECT_FALSE(may_round(ElementType::wedge6, std::span(moved).first(18)));
  EXPECT_TRUE(may_round(ElementType::hex8, moved));
  const Element incompressible(moved, 0.4999999);
  EXPECT_FALSE(incompressible.numbers());
  EXPECT_EQ(incompressible.rounded(), incompressible.stiffness);
}

}  // namespace
}  // namespace pounding::stiffness
