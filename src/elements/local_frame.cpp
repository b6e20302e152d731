#include "elements/local_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "elements/element_properties.h"

namespace pounding {
namespace {

constexpr double smallest_relative_length = 1e-12;
constexpr double smallest_sine = 1e-6;

std::string text(const Vector3& v) {
  std::ostringstream out;
  out << '(' << v[0] << ' ' << v[1] << ' ' << v[2] << ')';
  return out.str();
}

}  // namespace

Segment segment_between(std::span<const double> coordinates) {
  Vector3 axis{};
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    axis[i] = coordinates[3 + i] - coordinates[i];
    extent = std::max({extent, std::abs(coordinates[i]), std::abs(coordinates[3 + i])});
  }
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  // Negated so that it also catches a value that is not a number.
  if (!(length > smallest_relative_length * extent)) {
    std::ostringstream message;
    message << "zero length (" << length << " m between its two nodes)";
    throw ElementError(message.str());
  }
  return {{axis[0] / length, axis[1] / length, axis[2] / length}, length};
}

Matrix3 local_frame(const Vector3& x_axis, const Vector3& z_axis) {
  const double z_length = norm(z_axis);
  if (!(z_length > 0) || !std::isfinite(z_length)) {
    throw ElementError("z_axis " + text(z_axis) + " is not a direction");
  }
  const Vector3 across = cross(z_axis, x_axis);
  const double sine = norm(across) / z_length;
  if (!(sine > smallest_sine)) {
    throw ElementError("z_axis " + text(z_axis) + " is parallel to the axis of the element " +
                       text(x_axis) + "; give another one");
  }
  const double scale = 1.0 / (sine * z_length);
  const Vector3 y{across[0] * scale, across[1] * scale, across[2] * scale};
  return {x_axis, y, cross(x_axis, y)};
}

void rotate_to_global(const Matrix3& frame, std::span<double> matrix, int size) {
  const std::size_t n = size;
  for (std::size_t row = 0; row < n; row += 3) {
    for (std::size_t column = 0; column < n; column += 3) {
      Matrix3 right{};  // block times frame
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          for (std::size_t k = 0; k < 3; ++k) {
            right[i][j] += matrix[(row + i) * n + column + k] * frame[k][j];
          }
        }
      }
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          matrix[(row + i) * n + column + j] =
              frame[0][i] * right[0][j] + frame[1][i] * right[1][j] + frame[2][i] * right[2][j];
        }
      }
    }
  }
}

Vector3 rotate_diagonal_to_global(const Matrix3& frame, const Vector3& local) {
  Vector3 global{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) global[i] += frame[k][i] * frame[k][i] * local[k];
  }
  return global;
}

void mirror_lower_triangle(std::span<double> matrix, int size) {
  const std::size_t n = size;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) matrix[j * n + i] = matrix[i * n + j];
  }
}

void condense_last(std::span<double> matrix, int size, int kept, std::span<double> condensed) {
  const std::size_t n = size;
  const std::size_t m = kept;
  // Gaussian elimination from the last dof backwards; symmetric, so it needs no pivoting.
  for (std::size_t p = n; p-- > m;) {
    const double pivot = matrix[p * n + p];
    if (!(pivot > 0)) {
      std::ostringstream message;
      message << "internal modes without stiffness (pivot " << pivot
              << "); check young and poisson";
      throw ElementError(message.str());
    }
    for (std::size_t i = 0; i < p; ++i) {
      const double factor = matrix[p * n + i] / pivot;
      for (std::size_t j = 0; j <= i; ++j) matrix[i * n + j] -= factor * matrix[p * n + j];
    }
  }
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j <= i; ++j) condensed[i * m + j] = matrix[i * n + j];
  }
  mirror_lower_triangle(condensed, kept);
}

}  // namespace pounding
