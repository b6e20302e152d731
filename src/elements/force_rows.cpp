#include "elements/force_rows.h"

#include <cmath>
#include <cstddef>

#include "elements/flat_shell.h"
#include "elements/local_frame.h"

namespace pounding {
namespace {

constexpr std::array<std::string_view, 8> beam_names{"N",   "Vy",  "Vz",  "T",
                                                     "My1", "Mz1", "My2", "Mz2"};
constexpr std::array<std::string_view, 1> bar_names{"N"};
constexpr std::array<std::string_view, 6> spring_names{"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

/// Adds `factor` times the part of nodal forces along `axis`, three of them from `first` on.
void add_along(const Vector3& axis, double factor, std::size_t first, std::size_t size,
               std::span<const double> stiffness, double* row) {
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t j = 0; j < size; ++j) {
      row[j] += factor * axis[d] * stiffness[(first + d) * size + j];
    }
  }
}

constexpr std::size_t per_node = 6;
constexpr double least_level_cosine = 0.55;  // steeper shells are walls
constexpr double round_off = 1e-6;

/// Axes 1 and 2 in the local x and y of the element, and whether axis 3 is its z or the opposite.
struct Turn {
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  double side = 1;
};

Turn turn_from(const Matrix3& local, const Matrix3& axes) {
  return {dot(axes[0], local[0]), dot(axes[0], local[1]), dot(axes[1], local[0]),
          dot(axes[1], local[1]), dot(axes[2], local[2]) < 0 ? -1.0 : 1.0};
}

/// Writes the components 11, 22, 12 of a plane-stress tensor, `factor` times the strains.
void write_tensor(const std::array<std::vector<double>, 3>& strains, const PlaneModuli& moduli,
                  double factor, const Turn& turn, double* rows) {
  const std::size_t size = strains[0].size();
  for (std::size_t i = 0; i < size; ++i) {
    const double mean = moduli.bulk * (strains[0][i] + strains[1][i]);
    const double half = moduli.shear * (strains[0][i] - strains[1][i]);
    const double xx = factor * (mean + half);
    const double yy = factor * (mean - half);
    const double xy = factor * moduli.shear * strains[2][i];
    const auto component = [&](double ax, double ay, double bx, double by) {
      return ax * bx * xx + ay * by * yy + (ax * by + ay * bx) * xy;
    };
    rows[i] = component(turn.x1, turn.y1, turn.x1, turn.y1);
    rows[size + i] = component(turn.x2, turn.y2, turn.x2, turn.y2);
    rows[2 * size + i] = component(turn.x1, turn.y1, turn.x2, turn.y2);
  }
}

/// Carries a form from the feet of the nodes in the plane to the nodes and to global axes.
void to_global(const CentreStrains& strains, double* row) {
  constexpr std::size_t ux = 0, uy = 1, rx = 3, ry = 4;
  for (std::size_t node = 0; node < strains.heights.size(); ++node) {
    double* const of_node = row + per_node * node;
    of_node[ry] -= strains.heights[node] * of_node[ux];
    of_node[rx] += strains.heights[node] * of_node[uy];
    for (std::size_t first = 0; first < per_node; first += 3) {
      Vector3 global{};
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t c = 0; c < 3; ++c) global[c] += of_node[first + k] * strains.frame[k][c];
      }
      for (std::size_t c = 0; c < 3; ++c) of_node[first + c] = global[c];
    }
  }
}

}  // namespace

std::span<const std::string_view> end_force_names(ElementType type) {
  if (is_beam(type)) return beam_names;
  if (is_bar(type)) return bar_names;
  if (!is_spring(type)) return {};
  return {spring_names.data(), static_cast<std::size_t>(traits_of(type).layout.components)};
}

std::vector<double> end_force_rows(ElementType type, std::span<const double> coordinates,
                                   const ElementProperties& properties,
                                   std::span<const double> stiffness) {
  const ElementLayout layout = traits_of(type).layout;
  const auto size = static_cast<std::size_t>(layout.size());
  const std::size_t last = size - static_cast<std::size_t>(layout.components);  // its last node
  const std::size_t count = end_force_names(type).size();
  std::vector<double> rows(count * size, 0.0);
  if (is_spring(type)) {
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t j = 0; j < size; ++j) rows[c * size + j] = stiffness[(last + c) * size + j];
    }
    return rows;
  }
  const Vector3 direction = segment_between(coordinates).direction;
  if (!is_beam(type)) {
    add_along(direction, 1, last, size, stiffness, rows.data());
    return rows;
  }
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  constexpr std::size_t rotations = 3;
  for (std::size_t d = 0; d < 3; ++d) {
    add_along(frame[d], 1, last, size, stiffness, &rows[d * size]);
  }
  add_along(frame[0], 1, last + rotations, size, stiffness, &rows[3 * size]);
  for (std::size_t d = 1; d < 3; ++d) {
    add_along(frame[d], -1, rotations, size, stiffness, &rows[(3 + d) * size]);
    add_along(frame[d], 1, last + rotations, size, stiffness, &rows[(5 + d) * size]);
  }
  return rows;
}

Matrix3 shell_force_axes(const Vector3& normal) {
  Matrix3 axes{};
  if (std::abs(normal[2]) > least_level_cosine) {
    const double side = normal[2] < 0 ? -1.0 : 1.0;
    for (std::size_t c = 0; c < 3; ++c) axes[2][c] = side * normal[c];
    const double length = std::hypot(normal[1], normal[2]);
    axes[0] = {length, -normal[0] * normal[1] / length, -normal[0] * normal[2] / length};
    axes[1] = cross(axes[2], axes[0]);
    return axes;
  }
  const double length = std::hypot(normal[0], normal[1]);
  const Vector3 level{-normal[1] / length, normal[0] / length, 0};  // z cross normal
  const double ahead = std::abs(level[0]) > round_off ? level[0] : level[1];
  for (std::size_t c = 0; c < 3; ++c) axes[0][c] = ahead < 0 ? -level[c] : level[c];
  axes[1] = {-normal[2] * normal[0] / length, -normal[2] * normal[1] / length, length};
  axes[2] = cross(axes[0], axes[1]);
  return axes;
}

std::vector<double> shell_force_rows(ElementType type, std::span<const double> coordinates,
                                     const ElementProperties& properties) {
  ShellProperties shell;
  shell.young = properties.young;
  shell.poisson = properties.poisson;
  shell.thickness = properties.thickness;
  const CentreStrains strains = type == ElementType::shell3
                                    ? shell3_centre_strains(coordinates, shell)
                                    : shell4_centre_strains(coordinates, shell);
  const PlaneModuli moduli = checked_plane_moduli(shell);
  const Turn turn = turn_from(strains.frame, shell_force_axes(strains.frame[2]));
  const std::size_t size = strains.membrane[0].size();
  std::vector<double> rows(shell_force_names.size() * size);
  const double thickness = shell.thickness;
  write_tensor(strains.membrane, moduli, thickness, turn, rows.data());
  write_tensor(strains.curvature, moduli, turn.side * thickness * thickness * thickness / 12, turn,
               &rows[3 * size]);
  for (std::size_t i = 0; i < size; ++i) {
    const double x = turn.side * strains.shear_stiffness * strains.shear[0][i];
    const double y = turn.side * strains.shear_stiffness * strains.shear[1][i];
    rows[6 * size + i] = turn.x1 * x + turn.y1 * y;
    rows[7 * size + i] = turn.x2 * x + turn.y2 * y;
  }
  for (std::size_t k = 0; k < shell_force_names.size(); ++k) to_global(strains, &rows[k * size]);
  return rows;
}

std::vector<double> shell_strain_rows(ElementType type, std::span<const double> coordinates,
                                      const ElementProperties& properties) {
  const std::vector<double> forces = shell_force_rows(type, coordinates, properties);
  const std::size_t size = forces.size() / shell_force_names.size();
  std::vector<double> rows(6 * size);
  const double t = properties.thickness;
  for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
    const double stiffness = properties.young * (first == 0 ? t : t * t * t / 12);
    const double* const from = &forces[first * size];
    double* const to = &rows[first * size];
    for (std::size_t i = 0; i < size; ++i) {
      to[i] = (from[i] - properties.poisson * from[size + i]) / stiffness;
      to[size + i] = (from[size + i] - properties.poisson * from[i]) / stiffness;
      to[2 * size + i] = 2 * (1 + properties.poisson) * from[2 * size + i] / stiffness;
    }
  }
  return rows;
}

double shell_area(ElementType type, std::span<const double> x) {
  const auto between = [&](std::size_t a, std::size_t b) {
    return Vector3{x[3 * b] - x[3 * a], x[3 * b + 1] - x[3 * a + 1], x[3 * b + 2] - x[3 * a + 2]};
  };
  const bool triangle = type == ElementType::shell3;
  return norm(triangle ? cross(between(0, 1), between(0, 2))
                       : cross(between(0, 2), between(1, 3))) /
         2;
}

}  // namespace pounding
