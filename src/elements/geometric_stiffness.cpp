#include "elements/geometric_stiffness.h"

#include <array>
#include <cstddef>
#include <stdexcept>

#include "elements/beam2.h"
#include "elements/local_frame.h"

namespace pounding {
namespace {

constexpr std::size_t beam_size = 12;
constexpr std::size_t bar_size = 6;

/// One plane of a beam: deflection w, rotation component whose angle is `sign` times dw/dx.
void add_plane(std::size_t deflection, std::size_t rotation, double sign, double force, double phi,
               double length, std::span<double> matrix) {
  const double arm = sign * length;
  const double square = length * length;
  const double k = force / (30 * length) / ((1 + phi) * (1 + phi));
  const double across = 36 + (60 + 30 * phi) * phi;
  const double near = (4 + (5 + 2.5 * phi) * phi) * square;
  const double far = -(1 + (5 + 2.5 * phi) * phi) * square;
  const std::array<std::array<double, 4>, 4> local{{{across, 3 * arm, -across, 3 * arm},
                                                    {3 * arm, near, -3 * arm, far},
                                                    {-across, -3 * arm, across, -3 * arm},
                                                    {3 * arm, far, -3 * arm, near}}};
  const std::array<std::size_t, 4> dofs{deflection, rotation, deflection + 6, rotation + 6};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) matrix[dofs[i] * beam_size + dofs[j]] += k * local[i][j];
  }
}

void add_to_beam(std::span<const double> coordinates, const ElementProperties& properties,
                 double force, std::span<double> stiffness) {
  const auto [direction, length] = segment_between(coordinates);
  std::array<double, beam_size * beam_size> matrix{};
  const ShearFlexibility phi = shear_flexibility(properties, length);
  add_plane(1, 5, +1, force, phi.y, length, matrix);
  add_plane(2, 4, -1, force, phi.z, length, matrix);
  rotate_to_global(local_frame(direction, properties.z_axis), matrix, beam_size);
  mirror_lower_triangle(matrix, beam_size);
  for (std::size_t i = 0; i < matrix.size(); ++i) stiffness[i] += matrix[i];
}

void add_to_bar(std::span<const double> coordinates, double force, std::span<double> stiffness) {
  const auto [direction, length] = segment_between(coordinates);
  for (std::size_t i = 0; i < bar_size; ++i) {
    for (std::size_t j = 0; j < bar_size; ++j) {
      const double sign = (i < 3) == (j < 3) ? 1.0 : -1.0;
      const double across = (i % 3 == j % 3 ? 1.0 : 0.0) - direction[i % 3] * direction[j % 3];
      stiffness[i * bar_size + j] += sign * force / length * across;
    }
  }
}

}  // namespace

bool has_axial_force(ElementType type) {
  return is_beam(type) || type == ElementType::bar;
}

double axial_force(std::span<const double> coordinates, const ElementProperties& properties,
                   std::span<const double> displacements) {
  const auto [direction, length] = segment_between(coordinates);
  double elongation = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    elongation += direction[d] * (displacements[3 + d] - displacements[d]);
  }
  return properties.young * properties.area / length * elongation;
}

void add_geometric_stiffness(ElementType type, std::span<const double> coordinates,
                             const ElementProperties& properties, double axial_force,
                             std::span<double> stiffness) {
  if (is_beam(type)) {
    add_to_beam(coordinates, properties, axial_force, stiffness);
  } else if (type == ElementType::bar) {
    add_to_bar(coordinates, axial_force, stiffness);
  } else {
    throw std::logic_error("geometric stiffness of an element without an axial force");
  }
}

}  // namespace pounding
