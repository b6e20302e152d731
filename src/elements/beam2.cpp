#include "elements/beam2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "elements/local_frame.h"

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

/// Adds bending of a plane: deflection w, rotation component whose angle is `sign` times
/// dw/dx (+1 for r_z with u_y, -1 for r_y with u_z).
void add_bending(std::size_t deflection, std::size_t rotation, double sign, double rigidity,
                 double phi, double length, std::span<double> matrix) {
  const double arm = sign * length;
  const double k = rigidity / (length * length * length) / (1 + phi);
  const double near = (4 + phi) * (length * length);
  const double far = (2 - phi) * (length * length);
  const std::array<std::array<double, 4>, 4> local{{{12, 6 * arm, -12, 6 * arm},
                                                    {6 * arm, near, -6 * arm, far},
                                                    {-12, -6 * arm, 12, -6 * arm},
                                                    {6 * arm, far, -6 * arm, near}}};
  const std::array<std::size_t, 4> dofs{deflection, rotation, deflection + per_node,
                                        rotation + per_node};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) matrix[dofs[i] * beam2_size + dofs[j]] += k * local[i][j];
  }
}

double shear_modulus(const ElementProperties& properties) {
  return properties.young / (2 * (1 + properties.poisson));
}

/// Rotary inertia beside its own, `rotary`, of a beam in one plane at each node [kg m2], see
/// beam2.h. `mass` per length [kg/m].
double added_rotary_inertia(double rotary, double mass, double rigidity, double stretch, double phi,
                            double length, double frequency) {
  if (frequency == 0) return 0;
  constexpr double allowed_part = 0.001;
  const double square = length * length;
  const double bending = 12 * rigidity / (square * length * (1 + phi));
  const double a = mass * length / 4;
  const double b = bending / (frequency * frequency);
  const double missing = 4 * stretch / (mass * square * bending) - 1 / a;
  const double allowed =
      allowed_part * (rotary + std::min(2 * rigidity / (length * frequency * frequency),
                                        square / 2 * (a * b / (a + b))));
  if (!(missing > 0)) return 0;  // short and thick: it cannot
  return std::clamp(square / (2 * missing) - rotary, 0.0, allowed);
}

/// Lumped mass from its parts: of translation, and about the local axes.
void set_mass(const Matrix3& frame, double translation, const Vector3& local,
              std::span<double> lumped_mass) {
  const Vector3 rotation = rotate_diagonal_to_global(frame, local);
  for (std::size_t node = 0; node < 2; ++node) {
    for (std::size_t i = 0; i < 3; ++i) {
      lumped_mass[node * per_node + i] = translation;
      lumped_mass[node * per_node + 3 + i] = rotation[i];
    }
  }
}

}  // namespace

ShearFlexibility shear_flexibility(const ElementProperties& properties, double length) {
  const auto phi = [&](double inertia, double area) {
    if (area == 0) return 0.0;
    return 12 * properties.young * inertia / (shear_modulus(properties) * area * length * length);
  };
  return {phi(properties.inertia_z, properties.shear_area_y),
          phi(properties.inertia_y, properties.shear_area_z)};
}

double half_wave(const ElementProperties& p, double frequency) {
  const double mass = p.density * p.area + p.added_mass;
  const double square = frequency * frequency;
  const auto number = [&](double inertia, double area) {
    const double rigidity = p.young * inertia;
    const double shear = area == 0 ? 0 : 1 / (shear_modulus(p) * area);
    const double rotary = p.density * inertia;
    const double b = square * (rotary + mass * rigidity * shear);
    const double c = square * mass * (1 - square * rotary * shear);
    return std::sqrt((b + std::sqrt(b * b + 4 * rigidity * c)) / (2 * rigidity));
  };
  return std::numbers::pi /
         std::max(number(p.inertia_y, p.shear_area_z), number(p.inertia_z, p.shear_area_y));
}

double wave_frequency(const ElementProperties& p, double half_wave) {
  const double mass = p.density * p.area + p.added_mass;
  const double square = std::pow(std::numbers::pi / half_wave, 2);
  const auto squared = [&](double inertia, double area) {
    const double rigidity = p.young * inertia;
    const double shear = area == 0 ? 0 : 1 / (shear_modulus(p) * area);
    const double rotary = p.density * inertia;
    const double b = mass + (rotary + mass * rigidity * shear) * square;
    const double c = rigidity * square * square;
    return 2 * c / (b + std::sqrt(b * b - 4 * mass * rotary * shear * c));
  };
  return std::sqrt(
      std::min(squared(p.inertia_y, p.shear_area_z), squared(p.inertia_z, p.shear_area_y)));
}

double added_rotary_part(const ElementProperties& p, double length) {
  const ShearFlexibility phi = shear_flexibility(p, length);
  const double mass = p.density * p.area + p.added_mass;
  const auto part = [&](double inertia, double flexibility) {
    const double own = p.density * length / 2 * inertia;
    return added_rotary_inertia(own, mass, p.young * inertia, p.young * p.area, flexibility, length,
                                p.resolved_frequency) /
           own;
  };
  return std::max(part(p.inertia_y, phi.z), part(p.inertia_z, phi.y));
}

void beam2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                     std::span<double> stiffness) {
  const auto [direction, length] = segment_between(coordinates);
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  const double young = properties.young;
  const double shear = shear_modulus(properties);
  const ShearFlexibility phi = shear_flexibility(properties, length);
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  add_spring(ux, young * properties.area / length, stiffness);
  add_spring(rx, shear * properties.torsion / length, stiffness);
  add_bending(uy, rz, +1, young * properties.inertia_z, phi.y, length, stiffness);
  add_bending(uz, ry, -1, young * properties.inertia_y, phi.z, length, stiffness);
  rotate_to_global(frame, stiffness, beam2_size);
  mirror_lower_triangle(stiffness, beam2_size);
}

void beam2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                       std::span<double> lumped_mass) {
  const auto [direction, length] = segment_between(coordinates);
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  const ShearFlexibility phi = shear_flexibility(properties, length);
  const double half = properties.density * length / 2;
  const double mass = properties.density * properties.area + properties.added_mass;
  const auto rotary = [&, length = length](double inertia, double flexibility) {
    return half * inertia + added_rotary_inertia(half * inertia, mass, properties.young * inertia,
                                                 properties.young * properties.area, flexibility,
                                                 length, properties.resolved_frequency);
  };
  set_mass(frame, half * properties.area + properties.added_mass * length / 2,
           {half * (properties.inertia_y + properties.inertia_z),
            rotary(properties.inertia_y, phi.z), rotary(properties.inertia_z, phi.y)},
           lumped_mass);
}

void euler_beam_lumped_mass(std::span<const double> coordinates,
                            const ElementProperties& properties, std::span<double> lumped_mass) {
  const auto [direction, length] = segment_between(coordinates);
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  const double half = properties.density * length / 2;
  const double translation = half * properties.area + properties.added_mass * length / 2;
  const double chord = translation * length * length / 12;  // rho A L^3 / 24
  set_mass(frame, translation,
           {half * (properties.inertia_y + properties.inertia_z),
            chord + half * properties.inertia_y, chord + half * properties.inertia_z},
           lumped_mass);
}

void bar2_matrix(std::span<const double> coordinates, double value, std::span<double> matrix) {
  constexpr std::size_t size = 6;
  const Vector3 direction = segment_between(coordinates).direction;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double sign = (i < 3) == (j < 3) ? 1.0 : -1.0;
      matrix[i * size + j] = sign * value * direction[i % 3] * direction[j % 3];
    }
  }
  mirror_lower_triangle(matrix, size);
}

void bar2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness) {
  const double length = segment_between(coordinates).length;
  bar2_matrix(coordinates, properties.young * properties.area / length, stiffness);
}

void bar2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass) {
  const double length = segment_between(coordinates).length;
  std::fill(lumped_mass.begin(), lumped_mass.end(),
            (properties.density * properties.area + properties.added_mass) * length / 2);
}

}  // namespace pounding
