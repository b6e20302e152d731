// Elements of any shape by their strains against their exact matrices.

#include "stiffness/strains/strain_elements.h"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/matrix3.h"
#include "elements/element_traits.h"
#include "stiffness/strains/hexahedron_strains.h"
#include "stiffness/strains/shell_strains.h"

namespace pounding::stiffness {
namespace {

constexpr double tolerance = 1e-13;

ElementProperties concrete() {
  return {
      .young = 30e9, .poisson = 0.27, .density = 2400, .thickness = 0.2, .drilling_factor = 0.3};
}

/// Turned out of the axes, and moved away from the origin.
Vector3 placed(const Vector3& x) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Vector3 y{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
  return {7 + y[0], c * y[1] - s * y[2] - 3, s * y[1] + c * y[2] + 11};
}

/// A kind of element with random shapes of it: the corners of a box, moved.
template <typename Shape, ElementType element_type, bool flat, bool extruded = false>
struct Kind {
  using Strains = Shape;
  static constexpr ElementType type = element_type;

  static std::vector<double> coordinates(std::mt19937& generator) {
    constexpr std::array<Vector3, 8> corners{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    std::uniform_real_distribution<double> out(-1, 1);
    std::vector<double> result;
    for (std::size_t a = 0; a < Shape::node_count; ++a) {
      const double z = flat ? 0.03 * out(generator) : 0.3 * corners[a][2] + 0.05 * out(generator);
      const Vector3 moved{0.5 * corners[a][0] + 0.1 * out(generator),
                          0.4 * corners[a][1] + 0.1 * out(generator), z};
      const Vector3 x = extruded ? moved : placed(moved);
      result.insert(result.end(), x.begin(), x.end());
    }
    // Ends that are alike, and across axis 2.
    for (std::size_t i = 0; extruded && i < 12; ++i) {
      if (i % 3 == 2) result[i] = result[2];
      result[12 + i] = i % 3 == 2 ? result[2] + 0.3 : result[i];
    }
    return result;
  }
};

using Kinds = testing::Types<Kind<HexahedronStrains<false>, ElementType::hex8, false>,
                             Kind<HexahedronStrains<false>, ElementType::hex8_full, false>,
                             Kind<HexahedronStrains<true>, ElementType::hex8, false, true>,
                             Kind<HexahedronStrains<true>, ElementType::hex8_full, false, true>,
                             Kind<QuadrangleStrains, ElementType::shell4, true>,
                             Kind<TriangleStrains, ElementType::shell3, true>>;

/// Elements of some random shapes, each shape several times, with nodes of their own.
template <typename Kind>
class StrainElementsTest : public testing::Test {
 protected:
  using Shape = typename Kind::Strains;
  static constexpr std::size_t size = Shape::size;

  /// One shape per entry, which tells its number of elements.
  void build(const std::vector<std::size_t>& counts) {
    std::vector<typename StrainElements<Shape>::Numbers> shapes;
    std::vector<typename StrainElements<Shape>::Element> elements;
    std::vector<std::array<LocalIndex, 6>> of_node;
    for (const std::size_t count : counts) {
      coordinates_.push_back(Kind::coordinates(generator_));
      auto& matrix = matrices_.emplace_back(size * size);
      std::vector<double> mass(size);
      element_matrices(Kind::type, coordinates_.back(), concrete(), matrix, mass);
      shapes.push_back(Shape::numbers(coordinates_.back(), matrix));
      for (std::size_t e = 0; e < count; ++e) {
        typename StrainElements<Shape>::Element element{shapes.size() - 1, {}};
        for (LocalIndex& node : element.nodes) {
          node = static_cast<LocalIndex>(of_node.size());
          of_node.push_back({-1, -1, -1, -1, -1, -1});
          for (std::size_t c = 0; c < Shape::components; ++c) {
            of_node.back()[c] =
                node * static_cast<LocalIndex>(Shape::components) + static_cast<LocalIndex>(c);
          }
        }
        elements.push_back(element);
        shape_of_.push_back(shapes.size() - 1);
      }
    }
    dofs_ = size * elements.size();
    product_ = std::make_unique<StrainElements<Shape>>(shapes, elements,
                                                       static_cast<LocalIndex>(dofs_), of_node);
  }

  std::vector<double> apply(std::vector<double> w) const {
    w.resize(dofs_ + 6, 0.0);
    std::vector<double> q(dofs_ + 6, 0.0);
    product_->apply(w.data(), q.data());
    q.resize(dofs_);
    return q;
  }

  std::vector<double> random_field() {
    std::uniform_real_distribution<double> values(-1, 1);
    std::vector<double> field(dofs_);
    for (double& value : field) value = values(generator_);
    return field;
  }

  std::mt19937 generator_{42};
  std::size_t dofs_ = 0;
  std::vector<std::vector<double>> coordinates_;
  std::vector<std::vector<double>> matrices_;
  std::vector<std::size_t> shape_of_;
  std::unique_ptr<StrainElements<Shape>> product_;
};

TYPED_TEST_SUITE(StrainElementsTest, Kinds);

/// Shapes with one element, with a few, with many: each fills its lanes otherwise.
TYPED_TEST(StrainElementsTest, AgreesWithTheExactMatrices) {
  this->build({1, 3, 1, 1, 17, 3, 1, 1, 2, 40, 0, 16, 3, 3, 15, 1});
  const std::vector<double> w = this->random_field();
  const std::vector<double> found = this->apply(w);
  constexpr std::size_t size = TestFixture::size;
  for (std::size_t e = 0; e < this->shape_of_.size(); ++e) {
    const std::vector<double>& matrix = this->matrices_[this->shape_of_[e]];
    double largest = 0;
    double error = 0;
    for (std::size_t i = 0; i < size; ++i) {
      double expected = 0;
      for (std::size_t j = 0; j < size; ++j) expected += matrix[i * size + j] * w[size * e + j];
      largest = std::max(largest, std::abs(expected));
      error = std::max(error, std::abs(expected - found[size * e + i]));
    }
    EXPECT_LT(error, tolerance * largest) << "element " << e;
  }
}

TYPED_TEST(StrainElementsTest, IsSymmetric) {
  this->build({1, 1, 1, 1});
  const std::vector<double> x = this->random_field();
  const std::vector<double> y = this->random_field();
  const std::vector<double> kx = this->apply(x);
  const std::vector<double> ky = this->apply(y);
  long double difference = 0;
  double scale = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    difference += static_cast<long double>(y[i]) * kx[i] - static_cast<long double>(x[i]) * ky[i];
    scale += std::abs(y[i] * kx[i]);
  }
  EXPECT_LT(std::abs(static_cast<double>(difference)), 1e-15 * scale);
}

/// Of six motions, forces are the round-off of the displacements' digits.
TYPED_TEST(StrainElementsTest, RigidMotionsGiveNothing) {
  this->build({1, 1, 1});
  constexpr std::size_t size = TestFixture::size;
  constexpr std::size_t components = TestFixture::Shape::components;
  for (std::size_t motion = 0; motion < 6; ++motion) {
    std::vector<double> w(this->dofs_, 0.0);
    double largest_displacement = 0;
    for (std::size_t i = 0; i < this->dofs_; i += components) {
      const double* const x = &this->coordinates_[i / size][i % size / components * 3];
      Vector3 axis{};
      axis[motion % 3] = 1;
      const Vector3 moved = motion < 3 ? axis : cross(axis, {x[0], x[1], x[2]});
      std::copy(moved.begin(), moved.end(), &w[i]);
      if (motion >= 3 && components == 6) std::copy(axis.begin(), axis.end(), &w[i + 3]);
      for (const double u : moved)
        largest_displacement = std::max(largest_displacement, std::abs(u));
    }
    double stiffest = 0;
    for (const auto& matrix : this->matrices_) {
      for (std::size_t i = 0; i < size; ++i) stiffest = std::max(stiffest, matrix[i * (size + 1)]);
    }
    for (const double force : this->apply(w)) {
      EXPECT_LT(std::abs(force), 1e-14 * stiffest * largest_displacement) << "motion " << motion;
    }
  }
}

}  // namespace
}  // namespace pounding::stiffness
