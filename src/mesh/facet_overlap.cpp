#include "mesh/facet_overlap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/matrix3.h"
#include "mesh/facet_point.h"

namespace pounding {
namespace {

/// A point of a plane; the third coordinate is 0.
using Polygon = std::vector<Vector3>;

/// Less than this part of the facet in common is nothing.
constexpr double sliver = 1e-12;

/// Points and weights of Gauss and Legendre on 0 to 1.
struct GaussRule {
  std::vector<double> points, weights;
  explicit GaussRule(int count) {
    for (int i = 0; i < count; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
      double slope = 1;
      for (int turn = 0; turn < 20; ++turn) {  // Newton's iteration for a root of P_count
        double value = x;
        double before = 1;
        for (int k = 2; k <= count; ++k) {
          const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
          before = value;
          value = next;
        }
        slope = count * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      points.push_back((1 + x) / 2);
      weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
  }
};

/// Exact for products of shares, their bulges and arms of facets without distortion.
const GaussRule& rule(bool distorted) {
  static const GaussRule plain(4);
  static const GaussRule fine(8);
  return distorted ? fine : plain;
}

double turn(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    twice += turn(polygon[0], polygon[i - 1], polygon[i]);
  }
  return twice / 2;
}

Vector3 point_between(const Vector3& a, const Vector3& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// Part of a polygon to the left of the line from a to b.
Polygon cut(const Polygon& polygon, const Vector3& a, const Vector3& b) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3& from = polygon[i];
    const Vector3& to = polygon[(i + 1) % polygon.size()];
    const double left = turn(a, b, from);
    const double next = turn(a, b, to);
    if (left >= 0) kept.push_back(from);
    if ((left > 0 && next < 0) || (left < 0 && next > 0)) {
      kept.push_back(point_between(from, to, left / (left - next)));
    }
  }
  return kept;
}

/// Whether shares are no polynomials of the position.
bool is_distorted(std::span<const Vector3> corners) {
  if (corners.size() < 4) return false;
  const Vector3 across = minus(corners[2], corners[0]);
  const Vector3 other = minus(corners[1], corners[0]);
  const Vector3 last = minus(corners[3], corners[0]);
  const Vector3 rest{across[0] - other[0] - last[0], across[1] - other[1] - last[1],
                     across[2] - other[2] - last[2]};
  return norm(rest) > 1e-12 * norm(across);
}

/// The plane of a facet, along its normal.
class Plane {
 public:
  explicit Plane(std::span<const Vector3> corners) : origin_(corners[0]) {
    const Vector3 first = minus(corners[1], corners[corners.size() == 3 ? 0 : 3]);
    const Vector3 second = minus(corners[2], corners[0]);
    const Vector3 both = cross(first, second);
    has_area_ = norm(both) > 1e-10 * norm(first) * norm(second);
    const Vector3 normal = normalised(both);
    x_ = normalised(first);
    y_ = cross(normal, x_);
  }
  bool has_area() const { return has_area_; }
  Vector3 point(const Vector3& x) const {
    const Vector3 arm = minus(x, origin_);
    return {dot(arm, x_), dot(arm, y_), 0};
  }
  Polygon polygon(std::span<const Vector3> corners) const {
    Polygon polygon;
    for (const Vector3& corner : corners) polygon.push_back(point(corner));
    return polygon;
  }

 private:
  Vector3 origin_, x_{0, 0, 0}, y_{0, 0, 0};
  bool has_area_ = false;
};

/// Point of a facet whose corners are seen as `seen` that is seen at x.
OverlapPoint point_at(std::span<const Vector3> corners, std::span<const Vector3> seen,
                      const Vector3& x, double weight) {
  OverlapPoint found;
  const FacetPoint at = nearest_point(seen, x);
  found.shares = at.shares;
  found.bulges = at.bulges;
  found.weight = weight;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) found.x[d] += at.shares[i] * corners[i][d];
  }
  return found;
}

std::vector<OverlapPoint> of_lines(std::span<const Vector3> facet, std::span<const Vector3> other) {
  std::vector<OverlapPoint> points;
  const Vector3 line = minus(facet[1], facet[0]);
  const double square = dot(line, line);
  if (!(square > 0)) return points;
  const auto [low, high] = std::minmax({dot(minus(other[0], facet[0]), line) / square,
                                        dot(minus(other[1], facet[0]), line) / square});
  const double from = std::max(low, 0.0);
  const double to = std::min(high, 1.0);
  if (to - from <= sliver) return points;
  const GaussRule& gauss = rule(false);
  for (std::size_t q = 0; q < gauss.points.size(); ++q) {
    const Vector3 x = point_between(facet[0], facet[1], from + (to - from) * gauss.points[q]);
    points.push_back(point_at(facet, facet, x, (to - from) * std::sqrt(square) * gauss.weights[q]));
  }
  return points;
}

}  // namespace

std::vector<OverlapPoint> overlap_points(std::span<const Vector3> facet,
                                         std::span<const Vector3> other) {
  std::vector<OverlapPoint> points;
  if ((facet.size() == 2) != (other.size() == 2)) return points;
  if (facet.size() == 2) return of_lines(facet, other);
  const Plane plane(facet);
  if (!plane.has_area()) return points;
  const Polygon seen = plane.polygon(facet);
  Polygon common = plane.polygon(other);
  if (area_of(common) < 0) std::ranges::reverse(common);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    common = cut(common, seen[i], seen[(i + 1) % seen.size()]);
  }
  const double nothing = sliver * area_of(seen);
  const GaussRule& gauss = rule(is_distorted(facet) || is_distorted(other));
  for (std::size_t i = 2; i < common.size(); ++i) {
    const double twice = turn(common[0], common[i - 1], common[i]);
    if (twice <= nothing) continue;
    for (std::size_t a = 0; a < gauss.points.size(); ++a) {
      for (std::size_t b = 0; b < gauss.points.size(); ++b) {
        const Vector3 side = point_between(common[i - 1], common[i], gauss.points[b]);
        const Vector3 x = point_between(common[0], side, gauss.points[a]);
        points.push_back(point_at(facet, seen, x,
                                  twice * gauss.points[a] * gauss.weights[a] * gauss.weights[b]));
      }
    }
  }
  return points;
}

}  // namespace pounding
