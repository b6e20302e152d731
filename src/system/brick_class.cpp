#include "system/brick_class.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace pounding {
namespace {

constexpr std::size_t corner_count = 8;
constexpr std::size_t size = 3 * corner_count;
/// Corner bits of Gmsh's node order.
constexpr std::array<std::size_t, corner_count> gmsh_corner{0, 1, 3, 2, 4, 5, 7, 6};
constexpr double largest_leak = 1e-13;

using Matrix24 = std::array<double, size * size>;

/// The box in known axes, if it is one there.
std::optional<Brick> box_in(const Matrix3& axes, std::span<const double> coordinates,
                            double tolerance) {
  std::array<Vector3, corner_count> local{};
  Vector3 low{1e300, 1e300, 1e300};
  Vector3 high{-1e300, -1e300, -1e300};
  for (std::size_t a = 0; a < corner_count; ++a) {
    Vector3 x{};
    for (std::size_t d = 0; d < 3; ++d) x[d] = coordinates[3 * a + d] - coordinates[d];
    local[a] = multiply(axes, x);
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], local[a][d]);
      high[d] = std::max(high[d], local[a][d]);
    }
  }
  Brick brick;
  for (std::size_t d = 0; d < 3; ++d) brick.lengths[d] = high[d] - low[d];
  const double allowed = tolerance * *std::min_element(brick.lengths.begin(), brick.lengths.end());
  brick.corner.fill(-1);
  for (std::size_t a = 0; a < corner_count; ++a) {
    std::size_t bits = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const bool far = local[a][d] - low[d] > brick.lengths[d] / 2;
      const double face = far ? high[d] : low[d];
      if (!(std::abs(local[a][d] - face) <= allowed)) return std::nullopt;
      bits |= static_cast<std::size_t>(far) << d;
    }
    if (brick.corner[bits] >= 0) return std::nullopt;
    brick.corner[bits] = static_cast<int>(a);
  }
  return brick;
}

/// Orthonormal axes along the first edges of an element; nothing if they do not span space.
std::optional<Matrix3> edge_axes(std::span<const double> coordinates) {
  const auto edge = [&](std::size_t node) {
    Vector3 e{};
    for (std::size_t d = 0; d < 3; ++d) e[d] = coordinates[3 * node + d] - coordinates[d];
    return e;
  };
  const auto unit = [](Vector3 e) {
    const double length = norm(e);
    for (double& x : e) x /= length;
    return e;
  };
  const Vector3 x = unit(edge(1));
  const Vector3 z = unit(cross(x, edge(3)));
  const Matrix3 axes{x, cross(z, x), z};
  return std::isfinite(determinant(axes)) ? std::optional(axes) : std::nullopt;
}

/// B of a box with its own axes, rows and columns s + 8 c for component c in row s of H.
Matrix24 transformed_stiffness(ElementType type, const ElementProperties& properties,
                               const Vector3& lengths) {
  std::array<double, size> coordinates{};
  for (std::size_t a = 0; a < corner_count; ++a)
    for (std::size_t d = 0; d < 3; ++d)
      coordinates[3 * a + d] = (gmsh_corner[a] >> d & 1) != 0 ? lengths[d] : 0;
  Matrix24 stiffness{};
  std::array<double, size> mass{};
  element_matrices(type, coordinates, properties, stiffness, mass);
  const auto sign = [](std::size_t s, std::size_t node) {
    return std::popcount(s & ~gmsh_corner[node]) % 2 == 0 ? 1.0 : -1.0;
  };
  Matrix24 half{};  // H K
  Matrix24 result{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t s = 0; s < corner_count; ++s)
      for (std::size_t a = 0; a < corner_count; ++a)
        for (std::size_t j = 0; j < size; ++j)
          half[(s + 8 * c) * size + j] += sign(s, a) * stiffness[(3 * a + c) * size + j] / 64;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t s = 0; s < corner_count; ++s)
        for (std::size_t a = 0; a < corner_count; ++a)
          result[i * size + s + 8 * c] += half[i * size + 3 * a + c] * sign(s, a);
  return result;
}

/// Takes named entries out of B; what is left over when all are taken does not fit the pattern.
class Picker {
 public:
  explicit Picker(Matrix24& matrix) : matrix_(matrix) {}

  /// Entry of the values (component, row) i and j, and its mirror.
  double take(std::size_t i, std::size_t j) {
    const double value = matrix_[i * size + j];
    matrix_[i * size + j] = 0;
    matrix_[j * size + i] = 0;
    return value;
  }
  std::array<double, 6> take3(std::size_t i, std::size_t j, std::size_t k) {
    return {take(i, i), take(i, j), take(i, k), take(j, j), take(j, k), take(k, k)};
  }
  std::array<double, 3> take2(std::size_t i, std::size_t j) {
    return {take(i, i), take(i, j), take(j, j)};
  }

 private:
  Matrix24& matrix_;
};

constexpr std::size_t value(std::size_t component, std::size_t axes) {
  return axes + 8 * component;
}

double largest(const Matrix24& matrix) {
  double result = 0;
  for (const double entry : matrix) result = std::max(result, std::abs(entry));
  return result;
}

}  // namespace

std::optional<Brick> BrickFrames::recognise(std::span<const double> coordinates,
                                            double tolerance) const {
  for (std::size_t frame = 0; frame < axes_.size(); ++frame) {
    if (auto brick = box_in(axes_[frame], coordinates, tolerance)) {
      brick->frame = static_cast<int>(frame);
      return brick;
    }
  }
  return std::nullopt;
}

std::optional<Matrix3> BrickFrames::axes_of_box(std::span<const double> coordinates,
                                                double tolerance) {
  const auto axes = edge_axes(coordinates);
  return axes && box_in(*axes, coordinates, tolerance) ? axes : std::nullopt;
}

std::optional<BrickSplit> split_brick(ElementType type, const ElementProperties& properties,
                                      const Vector3& lengths) {
  Matrix24 b = transformed_stiffness(type, properties, lengths);
  const double scale = largest(b);
  Picker picker(b);
  BrickSplit split;
  split.dilation = picker.take3(value(0, 1), value(1, 2), value(2, 4));
  split.twist = picker.take3(value(0, 6), value(1, 5), value(2, 3));
  split.bending = {picker.take2(value(1, 3), value(2, 5)), picker.take2(value(0, 3), value(2, 6)),
                   picker.take2(value(0, 5), value(1, 6))};
  split.shear = {picker.take2(value(0, 2), value(1, 1)), picker.take2(value(0, 4), value(2, 1)),
                 picker.take2(value(1, 4), value(2, 2))};
  split.hourglass = {picker.take(value(0, 7), value(0, 7)), picker.take(value(1, 7), value(1, 7)),
                     picker.take(value(2, 7), value(2, 7))};
  return largest(b) <= largest_leak * scale ? std::optional(split) : std::nullopt;
}

}  // namespace pounding
