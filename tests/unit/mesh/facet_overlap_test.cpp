#include "mesh/facet_overlap.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/matrix3.h"

namespace pounding {
namespace facet_overlap_test {

using Corners = std::vector<Vector3>;

const Corners square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

template <typename Function>
double integral(const Corners& facet, const Corners& other, const Function& function) {
  double sum = 0;
  for (const OverlapPoint& point : overlap_points(facet, other)) {
    sum += point.weight * function(point);
  }
  return sum;
}

double size(const Corners& facet, const Corners& other) {
  return integral(facet, other, [](const OverlapPoint&) { return 1.0; });
}

TEST(FacetOverlap, IsWhatPolygonsHaveInCommon) {
  // x + y < 1.5 of the square, from either side and at a distance.
  const Corners triangle{{-0.5, -0.5, 2}, {2, -0.5, 2}, {-0.5, 2, 2}};
  const Corners turned{triangle[0], triangle[2], triangle[1]};
  for (const Corners& other : {triangle, turned}) {
    EXPECT_NEAR(size(square, other), 0.875, 1e-14);
    EXPECT_NEAR(size(other, square), 0.875, 1e-14);
    // Integrals of x^3 y^3 over 0 to 1, less those over the corner beyond the line.
    double corner = 0;
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
      const double x = 0.5 + 0.5 * (i + 0.5) / steps;
      corner += std::pow(x, 3) * (1 - std::pow(1.5 - x, 4)) / 4 * 0.5 / steps;
    }
    const double found = integral(square, other, [](const OverlapPoint& point) {
      EXPECT_EQ(point.x[2], 0);
      return std::pow(point.x[0] * point.x[1], 3);
    });
    EXPECT_NEAR(found, 1.0 / 16 - corner, 1e-7);
  }
}

TEST(FacetOverlap, OfAFacetWithItselfIsTheFacet) {
  const Corners skew{{0, 0, 0}, {2, 0.1, 0}, {1.6, 1.2, 0}, {-0.2, 0.9, 0}};
  const double area = norm(cross(minus(skew[2], skew[0]), minus(skew[3], skew[1]))) / 2;
  EXPECT_NEAR(size(skew, skew), area, 1e-14);
  for (const OverlapPoint& point : overlap_points(skew, skew)) {
    double sum = 0;
    for (const double share : point.shares) sum += share;
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(FacetOverlap, IsNothingBesideOrAcross) {
  const Corners beside{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  const Corners upright{{0, 0.5, -1}, {1, 0.5, -1}, {1, 0.5, 1}, {0, 0.5, 1}};
  const Corners line{{0, 0, 0}, {1, 1, 0}};
  const Corners flat{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_TRUE(overlap_points(square, beside).empty());
  EXPECT_TRUE(overlap_points(square, upright).empty());
  EXPECT_TRUE(overlap_points(square, line).empty());
  EXPECT_TRUE(overlap_points(line, square).empty());
  EXPECT_TRUE(overlap_points(flat, square).empty());
  EXPECT_TRUE(overlap_points(line, Corners{{1, 0, 0}, {0, 1, 0}}).empty());
}

TEST(FacetOverlap, OfLinesIsTheirCommonPart) {
  const Corners line{{0, 0, 0}, {3, 4, 0}};
  EXPECT_NEAR(size(line, {{0.6, 0.8, 1}, {9, 12, -1}}), 4, 1e-14);
  EXPECT_NEAR(size(line, {{9, 12, -1}, {0.6, 0.8, 1}}), 4, 1e-14);
  const double cube = integral(line, line, [](const OverlapPoint& point) {
    return std::pow(point.shares[1], 3) * point.bulges[0];
  });
  EXPECT_NEAR(cube, 5 * 4 * (1.0 / 5 - 1.0 / 6), 1e-14);
}

}  // namespace facet_overlap_test
}  // namespace pounding
