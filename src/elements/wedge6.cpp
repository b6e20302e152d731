#include "elements/wedge6.h"

#include <algorithm>
#include <cstddef>

#include "elements/gauss_rule.h"
#include "elements/isotropic_solid.h"
#include "elements/symmetric_matrix.h"

namespace pounding {

namespace {

constexpr std::size_t node_count = 6;
constexpr int wedge6_size = 3 * static_cast<int>(node_count);

/// Weight of each point: a third of the reference triangle's area of one half, times one.
constexpr double weight = 1.0 / 6;

using NodeCoordinates = std::array<Vector3, node_count>;

/// The rule (xi, eta, zeta), exact for quadratics in the triangle (0, 0), (1, 0), (0, 1) and for
/// cubics across it, -1 to 1.
constexpr std::array<Vector3, 6> gauss_points() {
  std::array<Vector3, 6> points{};
  for (std::size_t g = 0; g < points.size(); ++g) {
    points[g] = {g % 3 == 1 ? 2.0 / 3 : 1.0 / 6, g % 3 == 2 ? 2.0 / 3 : 1.0 / 6,
                 g < 3 ? -gauss_abscissa : gauss_abscissa};
  }
  return points;
}

/// Area coordinates of the triangle.
std::array<double, 3> areas(const Vector3& point) {
  return {1 - point[0] - point[1], point[0], point[1]};
}

std::array<double, node_count> shape_values(const Vector3& point) {
  const auto area = areas(point);
  std::array<double, node_count> values{};
  for (std::size_t a = 0; a < 3; ++a) {
    values[a] = area[a] * (1 - point[2]) / 2;
    values[a + 3] = area[a] * (1 + point[2]) / 2;
  }
  return values;
}

/// dN_a / d(xi, eta, zeta).
NodeCoordinates shape_derivatives(const Vector3& point) {
  constexpr std::array<std::array<double, 2>, 3> slopes{{{-1, -1}, {1, 0}, {0, 1}}};
  const auto area = areas(point);
  NodeCoordinates derivatives{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double below = (1 - point[2]) / 2;
    const double above = (1 + point[2]) / 2;
    derivatives[a] = {slopes[a][0] * below, slopes[a][1] * below, -area[a] / 2};
    derivatives[a + 3] = {slopes[a][0] * above, slopes[a][1] * above, area[a] / 2};
  }
  return derivatives;
}

Matrix3 jacobian(const NodeCoordinates& nodes, const Vector3& point) {
  return jacobian_of(nodes, shape_derivatives(point));
}

/// Refuses a wedge without positive volume at a point of the rule.
NodeCoordinates checked_nodes(std::span<const double> coordinates) {
  const NodeCoordinates nodes = relative_nodes<node_count>(coordinates);
  const double flat = flat_thickness(coordinates);
  for (const Vector3& point : gauss_points()) require_volume(jacobian(nodes, point), flat);
  return nodes;
}

}  // namespace

void wedge6_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> stiffness) {
  const NodeCoordinates nodes = checked_nodes(coordinates);
  const LameConstants lame = lame_constants(properties);
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  for (const Vector3& point : gauss_points()) {
    const Matrix3 here = jacobian(nodes, point);
    const Matrix3 inverse_here = inverse(here);
    NodeCoordinates gradients = shape_derivatives(point);
    for (Vector3& gradient : gradients) gradient = multiply(inverse_here, gradient);
    add_elastic_blocks(gradients, lame, weight * determinant(here), stiffness);
  }
  mirror_lower_triangle(stiffness, wedge6_size);
}

void wedge6_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                        std::span<double> lumped_mass) {
  const NodeCoordinates nodes = checked_nodes(coordinates);
  std::array<double, node_count> mass{};
  for (const Vector3& point : gauss_points()) {
    const double here = properties.density * weight * determinant(jacobian(nodes, point));
    const auto values = shape_values(point);
    for (std::size_t a = 0; a < node_count; ++a) mass[a] += here * values[a];
  }
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t i = 0; i < 3; ++i) lumped_mass[3 * a + i] = mass[a];
  }
}

}  // namespace pounding
