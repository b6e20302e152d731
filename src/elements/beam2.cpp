#include "elements/beam2.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "elements/local_frame.h"
#include "elements/symmetric_matrix.h"

namespace pounding {

namespace {

constexpr std::size_t beam2_size = 12;
constexpr std::size_t per_node = 6;

// Components of one node in local axes.
constexpr std::size_t ux = 0, uy = 1, uz = 2, rx = 3, ry = 4, rz = 5;

/// Adds a spring between one component of node 1 and the same of node 2.
void add_spring(std::size_t component, double value, std::span<double> matrix) {
  const std::size_t i = component;
  const std::size_t j = component + per_node;
  matrix[i * beam2_size + i] += value;
  matrix[j * beam2_size + j] += value;
  matrix[i * beam2_size + j] -= value;
  matrix[j * beam2_size + i] -= value;
}

/// Adds cubic bending of a plane: deflection w, rotation component whose angle is `sign` times
/// dw/dx (+1 for r_z with u_y, -1 for r_y with u_z).
void add_bending(std::size_t deflection, std::size_t rotation, double sign, double rigidity,
                 double length, std::span<double> matrix) {
  const double arm = sign * length;
  const double k = rigidity / (length * length * length);
  const double square = length * length;
  const std::array<std::array<double, 4>, 4> local{{{12, 6 * arm, -12, 6 * arm},
                                                    {6 * arm, 4 * square, -6 * arm, 2 * square},
                                                    {-12, -6 * arm, 12, -6 * arm},
                                                    {6 * arm, 2 * square, -6 * arm, 4 * square}}};
  const std::array<std::size_t, 4> dofs{deflection, rotation, deflection + per_node,
                                        rotation + per_node};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) matrix[dofs[i] * beam2_size + dofs[j]] += k * local[i][j];
  }
}

}  // namespace

void beam2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                     std::span<double> stiffness) {
  const auto [direction, length] = segment_between(coordinates);
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  const double young = properties.young;
  const double shear = young / (2 * (1 + properties.poisson));
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  add_spring(ux, young * properties.area / length, stiffness);
  add_spring(rx, shear * properties.torsion / length, stiffness);
  add_bending(uy, rz, +1, young * properties.inertia_z, length, stiffness);
  add_bending(uz, ry, -1, young * properties.inertia_y, length, stiffness);
  rotate_to_global(frame, stiffness, beam2_size);
  mirror_lower_triangle(stiffness, beam2_size);
}

void beam2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                       std::span<double> lumped_mass) {
  const auto [direction, length] = segment_between(coordinates);
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  const double half = properties.density * length / 2;
  const double translation = half * properties.area + properties.added_mass * length / 2;
  const double chord = translation * length * length / 12;  // rho A L^3 / 24
  const Vector3 rotation = rotate_diagonal_to_global(
      frame, {half * (properties.inertia_y + properties.inertia_z),
              chord + half * properties.inertia_y, chord + half * properties.inertia_z});
  for (std::size_t node = 0; node < 2; ++node) {
    for (std::size_t i = 0; i < 3; ++i) {
      lumped_mass[node * per_node + i] = translation;
      lumped_mass[node * per_node + 3 + i] = rotation[i];
    }
  }
}

}  // namespace pounding
