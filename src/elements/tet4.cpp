#include "elements/tet4.h"

#include <algorithm>
#include <cstddef>

#include "elements/isotropic_solid.h"
#include "elements/symmetric_matrix.h"

namespace pounding {

namespace {

constexpr std::size_t node_count = 4;
constexpr int tet4_size = 3 * static_cast<int>(node_count);

/// dN_a / d(xi, eta, zeta).
constexpr std::array<Vector3, node_count> shape_derivatives{
    {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Jacobian of a tetrahedron that has a positive volume.
Matrix3 checked_jacobian(std::span<const double> coordinates) {
  const Matrix3 result = jacobian_of(relative_nodes<node_count>(coordinates), shape_derivatives);
  require_volume(result, flat_thickness(coordinates));
  return result;
}

}  // namespace

void tet4_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness) {
  const Matrix3 jacobian = checked_jacobian(coordinates);
  const Matrix3 inverse_jacobian = inverse(jacobian);
  std::array<Vector3, node_count> gradients{};
  for (std::size_t a = 0; a < node_count; ++a) {
    gradients[a] = multiply(inverse_jacobian, shape_derivatives[a]);
  }
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  add_elastic_blocks(gradients, lame_constants(properties), determinant(jacobian) / 6, stiffness);
  mirror_lower_triangle(stiffness, tet4_size);
}

void tet4_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass) {
  const double volume = determinant(checked_jacobian(coordinates)) / 6;
  std::fill(lumped_mass.begin(), lumped_mass.end(), properties.density * volume / node_count);
}

}  // namespace pounding
