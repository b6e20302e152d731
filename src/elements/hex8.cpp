#include "elements/hex8.h"

#include <array>
#include <cstddef>

#include "elements/gauss_rule.h"
#include "elements/isotropic_solid.h"
#include "elements/symmetric_matrix.h"

namespace pounding {

namespace {

constexpr std::size_t node_count = 8;
constexpr std::size_t mode_count = 3;
constexpr int hex8_size = 3 * static_cast<int>(node_count);
constexpr std::size_t shape_count = node_count + mode_count;

using NodeCoordinates = std::array<Vector3, node_count>;
using Gradients = std::array<Vector3, shape_count>;

std::array<double, node_count> shape_values(const Vector3& point) {
  std::array<double, node_count> values{};
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector3& s = hex_corners[a];
    values[a] = 0.125 * (1 + s[0] * point[0]) * (1 + s[1] * point[1]) * (1 + s[2] * point[2]);
  }
  return values;
}

/// dN_a / d(xi, eta, zeta).
std::array<Vector3, node_count> shape_derivatives(const Vector3& point) {
  std::array<Vector3, node_count> derivatives{};
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector3& s = hex_corners[a];
    const Vector3 f{1 + s[0] * point[0], 1 + s[1] * point[1], 1 + s[2] * point[2]};
    derivatives[a] = {0.125 * s[0] * f[1] * f[2], 0.125 * s[1] * f[2] * f[0],
                      0.125 * s[2] * f[0] * f[1]};
  }
  return derivatives;
}

Matrix3 jacobian(const NodeCoordinates& nodes, const Vector3& point) {
  return jacobian_of(nodes, shape_derivatives(point));
}

/// Refuses a brick without positive volume at a Gauss point. The corners are not asked: the solid
/// patch of MacNeal and Harder has one that is folded.
NodeCoordinates checked_nodes(std::span<const double> coordinates) {
  const NodeCoordinates nodes = relative_nodes<node_count>(coordinates);
  const double flat = flat_thickness(coordinates);
  for (const Vector3& point : hex_gauss_points()) require_volume(jacobian(nodes, point), flat);
  return nodes;
}

/// The map at the centre, which carries the incompatible modes.
struct CentreMap {
  Matrix3 inverse_jacobian{};
  double determinant = 0;
};

/// Gradients in space at `point`: the eight nodal functions, then the three modes. The modes are
/// mapped with the centre's Jacobian and scaled by det J0 / det J: their integral over the element
/// is then zero, so a constant stress does no work on them.
Gradients gradients_at(const Vector3& point, const Matrix3& jacobian_here,
                       const CentreMap& centre) {
  Gradients gradients{};
  const Matrix3 inverse_here = inverse(jacobian_here);
  const auto derivatives = shape_derivatives(point);
  for (std::size_t a = 0; a < node_count; ++a) {
    gradients[a] = multiply(inverse_here, derivatives[a]);
  }
  const double scale = centre.determinant / determinant(jacobian_here);
  for (std::size_t m = 0; m < mode_count; ++m) {
    for (std::size_t i = 0; i < 3; ++i) {
      gradients[node_count + m][i] = -2 * point[m] * scale * centre.inverse_jacobian[i][m];
    }
  }
  return gradients;
}

}  // namespace

void hex8_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    Hex8Formulation formulation, std::span<double> stiffness) {
  const NodeCoordinates nodes = checked_nodes(coordinates);
  const LameConstants lame = lame_constants(properties);
  const bool incompatible = formulation == Hex8Formulation::incompatible;
  const std::size_t count = incompatible ? shape_count : node_count;

  const Matrix3 centre_jacobian = jacobian(nodes, {0, 0, 0});
  const CentreMap centre{inverse(centre_jacobian), determinant(centre_jacobian)};
  std::array<double, 9 * shape_count * shape_count> matrix{};
  for (const Vector3& point : hex_gauss_points()) {
    const Matrix3 here = jacobian(nodes, point);
    const Gradients gradients = gradients_at(point, here, centre);
    add_elastic_blocks({gradients.data(), count}, lame, determinant(here), matrix);
  }
  condense_last(matrix, 3 * static_cast<int>(count), hex8_size, stiffness);
}

void hex8_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass) {
  const NodeCoordinates nodes = checked_nodes(coordinates);
  std::array<double, node_count> mass{};
  for (const Vector3& point : hex_gauss_points()) {
    const double weight = properties.density * determinant(jacobian(nodes, point));
    const auto values = shape_values(point);
    for (std::size_t a = 0; a < node_count; ++a) mass[a] += weight * values[a];
  }
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t i = 0; i < 3; ++i) lumped_mass[3 * a + i] = mass[a];
  }
}

}  // namespace pounding
