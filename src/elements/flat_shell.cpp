#include "elements/flat_shell.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/array_reductions.h"
#include "elements/local_frame.h"

namespace pounding {

namespace {

constexpr std::size_t per_node = 6;
constexpr double smallest_relative_length = 1e-12;

/// Places of (ux, uy, rz) and (uz, rx, ry) among the components of a node.
constexpr std::array<std::size_t, 3> membrane_components{0, 1, 5};
constexpr std::array<std::size_t, 3> plate_components{2, 3, 4};

/// Writes a lower triangle into both triangles of the stiffness.
void scatter(std::span<const double> part, const std::array<std::size_t, 3>& components,
             std::size_t nodes, std::span<double> stiffness) {
  const std::size_t size = per_node * nodes;
  const auto place = [&](std::size_t i) { return per_node * (i / 3) + components[i % 3]; };
  for (std::size_t i = 0; i < 3 * nodes; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      stiffness[place(i) * size + place(j)] = stiffness[place(j) * size + place(i)] =
          part[i * 3 * nodes + j];
    }
  }
}

/// K <- T' K T, where the foot of each node in the plane moves by ux - z ry, uy + z rx.
void add_rigid_links(std::span<const double> heights, std::span<double> stiffness) {
  constexpr std::size_t ux = 0, uy = 1, rx = 3, ry = 4;
  const std::size_t size = per_node * heights.size();
  for (std::size_t node = 0; node < heights.size(); ++node) {
    const std::size_t first = per_node * node;
    const double z = heights[node];
    for (std::size_t i = 0; i < size; ++i) {
      stiffness[i * size + first + ry] -= z * stiffness[i * size + first + ux];
      stiffness[i * size + first + rx] += z * stiffness[i * size + first + uy];
    }
    for (std::size_t i = 0; i < size; ++i) {
      stiffness[(first + ry) * size + i] -= z * stiffness[(first + ux) * size + i];
      stiffness[(first + rx) * size + i] += z * stiffness[(first + uy) * size + i];
    }
  }
}

void require_thickness(double thickness) {
  if (thickness > 0 && std::isfinite(thickness)) return;
  std::ostringstream message;
  message << "thickness " << thickness << " m is not positive";
  throw ElementError(message.str());
}

}  // namespace

PlaneModuli checked_plane_moduli(const ShellProperties& properties) {
  require_thickness(properties.thickness);
  return {properties.young / (2 * (1 - properties.poisson)),
          properties.young / (2 * (1 + properties.poisson))};
}

void assemble_shell(std::span<const double> membrane, std::span<const double> plate,
                    std::span<const double> heights, const Matrix3& frame,
                    std::span<double> stiffness) {
  const std::size_t nodes = heights.size();
  const int size = static_cast<int>(per_node * nodes);
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  scatter(membrane, membrane_components, nodes, stiffness);
  scatter(plate, plate_components, nodes, stiffness);
  add_rigid_links(heights, stiffness);
  rotate_to_global(frame, stiffness, size);
  mirror_lower_triangle(stiffness, size);
}

void shell_lumped_mass(std::span<const double> nodal_areas, const ShellProperties& properties,
                       std::span<double> lumped_mass) {
  require_thickness(properties.thickness);
  double area = 0;
  for (const double nodal : nodal_areas) area += nodal;
  const double thickness = properties.thickness;
  const double square_radius =
      std::max(thickness * thickness / 12, properties.rotary_inertia_factor * area);
  for (std::size_t node = 0; node < nodal_areas.size(); ++node) {
    const double mass =
        (properties.density * thickness + properties.added_mass) * nodal_areas[node];
    for (std::size_t i = 0; i < 3; ++i) {
      lumped_mass[per_node * node + i] = mass;
      lumped_mass[per_node * node + 3 + i] = mass * square_radius;
    }
  }
}

void set_plane_strains(std::span<const std::array<double, 2>> gradients, CentreStrains& strains) {
  constexpr std::size_t ux = 0, uy = 1, rx = 3, ry = 4;
  const std::vector<double> none(per_node * gradients.size(), 0.0);
  strains.membrane.fill(none);
  strains.curvature.fill(none);
  for (std::size_t node = 0; node < gradients.size(); ++node) {
    const std::size_t first = per_node * node;
    const auto [x, y] = gradients[node];
    strains.membrane[0][first + ux] = strains.membrane[2][first + uy] = x;
    strains.membrane[1][first + uy] = strains.membrane[2][first + ux] = y;
    strains.curvature[0][first + ry] = x;
    strains.curvature[1][first + rx] = -y;
    strains.curvature[2][first + ry] = y;
    strains.curvature[2][first + rx] = -x;
  }
}

void set_shear_strains(std::span<const double> along_x, std::span<const double> along_y,
                       CentreStrains& strains) {
  strains.shear.fill(std::vector<double>(2 * along_x.size(), 0.0));
  for (std::size_t i = 0; i < along_x.size(); ++i) {
    const std::size_t place = per_node * (i / 3) + plate_components[i % 3];
    strains.shear[0][place] = along_x[i];
    strains.shear[1][place] = along_y[i];
  }
}

double negligible_length(std::span<const double> coordinates) {
  return smallest_relative_length * largest_magnitude(coordinates);
}

}  // namespace pounding
