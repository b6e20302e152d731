#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "common/types.h"

/// Vectors and 3 x 3 matrices of the size of space.
namespace pounding {

/// Rows of a 3 x 3 matrix.
using Matrix3 = std::array<Vector3, 3>;

inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double norm(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double square_between(const Vector3& a, const Vector3& b) {
  return dot(minus(a, b), minus(a, b));
}

/// The vector of length 1 along `a`; zero stays zero.
inline Vector3 normalised(const Vector3& a) {
  const double length = norm(a);
  return length > 0 ? Vector3{a[0] / length, a[1] / length, a[2] / length} : a;
}

inline double determinant(const Matrix3& m) {
  return dot(m[0], cross(m[1], m[2]));
}

/// Inverse by cofactors; the determinant must not be zero.
inline Matrix3 inverse(const Matrix3& m) {
  const double scale = 1.0 / determinant(m);
  const Matrix3 columns{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = scale * columns[j][i];
  }
  return result;
}

inline Vector3 multiply(const Matrix3& m, const Vector3& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

/// Row of a rigid motion: displacement (component 0-2) or rotation (3-5) of a point at `arm` from
/// the origin under unit translations along x, y, z and unit rotations about them there,
/// u = t + theta x arm.
inline std::array<double, 6> rigid_motion_row(std::size_t component, const Vector3& arm) {
  std::array<double, 6> row{};
  row[component] = 1;
  if (component < 3) {
    const std::size_t next = (component + 1) % 3;
    const std::size_t last = (component + 2) % 3;
    row[3 + next] = arm[last];
    row[3 + last] = -arm[next];
  }
  return row;
}

}  // namespace pounding
