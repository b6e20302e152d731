#include "mesh/facet_point.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "common/matrix3.h"

namespace pounding {
namespace facet_point_test {

const std::vector<Vector3> triangle{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
const std::vector<Vector3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
/// Corners of a quadrangle in no plane.
const std::vector<Vector3> warped{{0, 0, 0}, {2, 0.2, 0.3}, {2.3, 1.7, -0.2}, {-0.1, 1.2, 0.4}};

Vector3 at(const FacetPoint& found, const std::vector<Vector3>& corners) {
  Vector3 point{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) point[d] += found.shares[i] * corners[i][d];
  }
  return point;
}

TEST(FacetPoint, IsBelowAPointAboveTheFacet) {
  for (const auto& corners : {triangle, square}) {
    const FacetPoint found = nearest_point(corners, {0.5, 0.25, -0.7});
    EXPECT_NEAR(found.distance, 0.7, 1e-15);
    EXPECT_NEAR(norm(minus(found.x, {0.5, 0.25, 0})), 0, 1e-15);
    EXPECT_NEAR(norm(minus(found.x, at(found, corners))), 0, 1e-15);
    EXPECT_NEAR(std::abs(found.normal[2]), 1, 1e-15);
    EXPECT_NEAR(found.size, 1, 1e-14);
  }
}

TEST(FacetPoint, IsOnTheBorderBesideTheFacet) {
  const FacetPoint edge = nearest_point(square, {0.25, -0.5, 0});
  EXPECT_DOUBLE_EQ(edge.distance, 0.5);
  EXPECT_DOUBLE_EQ(edge.shares[0], 0.75);
  EXPECT_DOUBLE_EQ(edge.shares[1], 0.25);
  EXPECT_EQ(edge.shares[2], 0);
  const FacetPoint corner = nearest_point(triangle, {3, -1, 0});
  EXPECT_DOUBLE_EQ(corner.distance, std::sqrt(2.0));
  EXPECT_EQ(corner.shares[1], 1);
  // Beyond the long side of the triangle: its foot on that side.
  const FacetPoint side = nearest_point(triangle, {1 + 0.5, 0.5 + 1, 0});
  EXPECT_NEAR(norm(minus(side.x, {1, 0.5, 0})), 0, 1e-15);
}

TEST(FacetPoint, OfALineIsItsFootOrAnEnd) {
  const std::vector<Vector3> line{{1, 1, 1}, {3, 1, 1}};
  const FacetPoint middle = nearest_point(line, {1.5, 2, 1});
  EXPECT_DOUBLE_EQ(middle.shares[0], 0.75);
  EXPECT_DOUBLE_EQ(middle.distance, 1);
  EXPECT_DOUBLE_EQ(middle.size, 2);
  EXPECT_EQ(nearest_point(line, {9, 1, 1}).shares[1], 1);
}

TEST(FacetPoint, IsTheNearestOneOfAWarpedQuadrangle) {
  for (const Vector3& x : {Vector3{1, 0.7, 0.5}, {0.4, 0.4, -0.3}, {2.5, 1, 0}, {-1, 2, 1}}) {
    const FacetPoint found = nearest_point(warped, x);
    double least = 1e300;
    for (int i = 0; i <= 400; ++i) {
      for (int j = 0; j <= 400; ++j) {
        const double a = i / 400.0;
        const double b = j / 400.0;
        FacetPoint other;
        other.shares = {(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b};
        least = std::min(least, norm(minus(x, at(other, warped))));
      }
    }
    EXPECT_LE(found.distance, least + 1e-12);
    EXPECT_GT(found.distance, least - 2e-3);
  }
}

TEST(FacetPoint, GradientsAreThoseOfLinearFieldsAlongTheFacet) {
  for (const auto& corners : {triangle, square, warped}) {
    const FacetPoint found = nearest_point(corners, {0.6, 0.3, 0.2});
    const Vector3 slope{0.3, -1.1, 0.7};
    Vector3 gradient{0, 0, 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t d = 0; d < 3; ++d) {
        gradient[d] += found.gradients[i][d] * dot(slope, corners[i]);
      }
    }
    const double out = dot(slope, found.normal);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(gradient[d], slope[d] - out * found.normal[d], 1e-14);
    }
  }
}

TEST(FacetPoint, BulgesMakeQuadraticFieldsOfTheirEdges) {
  // Of x -> (x.a)^2, shares and bulges of the edges' middles give what lies on the border exactly.
  const Vector3 a{0.7, -0.4, 0.2};
  const auto square_of = [&](const Vector3& x) { return dot(a, x) * dot(a, x); };
  for (const auto& corners : {triangle, square, warped}) {
    for (std::size_t e = 0; e < corners.size(); ++e) {
      const Vector3& from = corners[e];
      const Vector3& to = corners[(e + 1) % corners.size()];
      Vector3 x{};
      for (std::size_t d = 0; d < 3; ++d) x[d] = 0.7 * from[d] + 0.3 * to[d];
      const FacetPoint found = nearest_point(corners, x);
      double value = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3& next = corners[(i + 1) % corners.size()];
        const double turn = std::pow(dot(a, minus(next, corners[i])), 2) / 4;
        value += found.shares[i] * square_of(corners[i]) - found.bulges[i] * turn;
      }
      EXPECT_NEAR(value, square_of(x), 1e-13);
    }
  }
  EXPECT_DOUBLE_EQ(nearest_point(std::vector<Vector3>{{0, 0, 0}, {4, 0, 0}}, {2, 1, 0}).bulges[0],
                   1);
}

TEST(FacetPoint, HasNoNormalWithoutArea) {
  const std::vector<Vector3> flat{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(norm(nearest_point(flat, {0.5, 1, 0}).normal), 0);
}

}  // namespace facet_point_test
}  // namespace pounding
