#include "mesh/facet_place.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "common/matrix3.h"

namespace pounding {
namespace facet_place_test {

const std::vector<Vector3> triangle{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
const std::vector<Vector3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
/// Corners of a quadrangle in no plane.
const std::vector<Vector3> warped{{0, 0, 0}, {2, 0.2, 0.3}, {2.3, 1.7, -0.2}, {-0.1, 1.2, 0.4}};

Vector3 at(const FacetPlace& found, const std::vector<Vector3>& corners) {
  Vector3 place{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) place[d] += found.shares[i] * corners[i][d];
  }
  return place;
}

TEST(FacetPlace, IsBelowAPointAboveTheFacet) {
  for (const auto& corners : {triangle, square}) {
    const FacetPlace found = nearest_place(corners, {0.5, 0.25, -0.7});
    EXPECT_NEAR(found.distance, 0.7, 1e-15);
    EXPECT_NEAR(norm(minus(found.place, {0.5, 0.25, 0})), 0, 1e-15);
    EXPECT_NEAR(norm(minus(found.place, at(found, corners))), 0, 1e-15);
    EXPECT_NEAR(std::abs(found.normal[2]), 1, 1e-15);
    EXPECT_NEAR(found.size, 1, 1e-14);
  }
}

TEST(FacetPlace, IsOnTheBorderBesideTheFacet) {
  const FacetPlace edge = nearest_place(square, {0.25, -0.5, 0});
  EXPECT_DOUBLE_EQ(edge.distance, 0.5);
  EXPECT_DOUBLE_EQ(edge.shares[0], 0.75);
  EXPECT_DOUBLE_EQ(edge.shares[1], 0.25);
  EXPECT_EQ(edge.shares[2], 0);
  const FacetPlace corner = nearest_place(triangle, {3, -1, 0});
  EXPECT_DOUBLE_EQ(corner.distance, std::sqrt(2.0));
  EXPECT_EQ(corner.shares[1], 1);
  // Beyond the long side of the triangle: its foot on that side.
  const FacetPlace side = nearest_place(triangle, {1 + 0.5, 0.5 + 1, 0});
  EXPECT_NEAR(norm(minus(side.place, {1, 0.5, 0})), 0, 1e-15);
}

TEST(FacetPlace, OfALineIsItsFootOrAnEnd) {
  const std::vector<Vector3> line{{1, 1, 1}, {3, 1, 1}};
  const FacetPlace middle = nearest_place(line, {1.5, 2, 1});
  EXPECT_DOUBLE_EQ(middle.shares[0], 0.75);
  EXPECT_DOUBLE_EQ(middle.distance, 1);
  EXPECT_DOUBLE_EQ(middle.size, 2);
  EXPECT_EQ(nearest_place(line, {9, 1, 1}).shares[1], 1);
}

TEST(FacetPlace, IsTheNearestOneOfAWarpedQuadrangle) {
  for (const Vector3& x : {Vector3{1, 0.7, 0.5}, {0.4, 0.4, -0.3}, {2.5, 1, 0}, {-1, 2, 1}}) {
    const FacetPlace found = nearest_place(warped, x);
    double least = 1e300;
    for (int i = 0; i <= 400; ++i) {
      for (int j = 0; j <= 400; ++j) {
        const double a = i / 400.0;
        const double b = j / 400.0;
        FacetPlace other;
        other.shares = {(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b};
        least = std::min(least, norm(minus(x, at(other, warped))));
      }
    }
    EXPECT_LE(found.distance, least + 1e-12);
    EXPECT_GT(found.distance, least - 2e-3);
  }
}

TEST(FacetPlace, GradientsAreThoseOfLinearFieldsAlongTheFacet) {
  for (const auto& corners : {triangle, square, warped}) {
    const FacetPlace found = nearest_place(corners, {0.6, 0.3, 0.2});
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

TEST(FacetPlace, BulgesMakeQuadraticFieldsOfTheirEdges) {
  // Of x -> (x.a)^2, shares and bulges of the edges' middles give what lies on the border exactly.
  const Vector3 a{0.7, -0.4, 0.2};
  const auto square_of = [&](const Vector3& x) { return dot(a, x) * dot(a, x); };
  for (const auto& corners : {triangle, square, warped}) {
    for (std::size_t e = 0; e < corners.size(); ++e) {
      const Vector3& from = corners[e];
      const Vector3& to = corners[(e + 1) % corners.size()];
      Vector3 x{};
      for (std::size_t d = 0; d < 3; ++d) x[d] = 0.7 * from[d] + 0.3 * to[d];
      const FacetPlace found = nearest_place(corners, x);
      double value = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3& next = corners[(i + 1) % corners.size()];
        const double turn = std::pow(dot(a, minus(next, corners[i])), 2) / 4;
        value += found.shares[i] * square_of(corners[i]) - found.bulges[i] * turn;
      }
      EXPECT_NEAR(value, square_of(x), 1e-13);
    }
  }
  EXPECT_DOUBLE_EQ(nearest_place(std::vector<Vector3>{{0, 0, 0}, {4, 0, 0}}, {2, 1, 0}).bulges[0],
                   1);
}

TEST(FacetPlace, HasNoNormalWithoutArea) {
  const std::vector<Vector3> flat{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(norm(nearest_place(flat, {0.5, 1, 0}).normal), 0);
}

}  // namespace facet_place_test
}  // namespace pounding
