#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>

#include "elements/flat_shell.h"

namespace pounding {

namespace {

constexpr std::size_t node_count = 3;
constexpr std::size_t plane_size = 3 * node_count;  // dofs of the membrane, or of the plate
constexpr double shear_stabilisation = 0.1;

using PlaneMatrix = std::array<double, plane_size * plane_size>;

/// The element in its plane: local axes in the rows of `frame`, nodes in them.
struct FlatTriangle {
  Matrix3 frame{};
  std::array<Vector2, node_count> nodes{};
  double area = 0;
  double longest_edge = 0;
  std::array<Vector2, node_count> gradients{};  ///< of the three area coordinates [1/m]
};

FlatTriangle checked_triangle(std::span<const double> coordinates) {
  const std::array<Vector3, node_count> x = relative_nodes<node_count>(coordinates);
  const Vector3 normal = cross(x[1], x[2]);
  const Vector3 third = minus(x[2], x[1]);
  FlatTriangle triangle;
  triangle.area = norm(normal) / 2;
  triangle.longest_edge = std::max({norm(x[1]), norm(x[2]), norm(third)});
  // Negated so that it also catches a value that is not a number.
  if (!(triangle.area > negligible_length(coordinates) * triangle.longest_edge)) {
    std::ostringstream message;
    message << "non-positive area " << triangle.area << " m2";
    throw ElementError(message.str());
  }
  const double length = norm(x[1]);
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.frame[0][i] = x[1][i] / length;
    triangle.frame[2][i] = normal[i] / (2 * triangle.area);
  }
  triangle.frame[1] = cross(triangle.frame[2], triangle.frame[0]);
  for (std::size_t a = 0; a < node_count; ++a) {
    triangle.nodes[a] = {dot(triangle.frame[0], x[a]), dot(triangle.frame[1], x[a])};
  }
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector2& b = triangle.nodes[(a + 1) % node_count];
    const Vector2& c = triangle.nodes[(a + 2) % node_count];
    triangle.gradients[a] = {(b[1] - c[1]) / (2 * triangle.area),
                             (c[0] - b[0]) / (2 * triangle.area)};
  }
  return triangle;
}

/// Area coordinates of the middle of the edge opposite node g; the three of them, each with a third
/// of the area, integrate quadratics exactly.
std::array<double, node_count> edge_middle(std::size_t g) {
  std::array<double, node_count> values{0.5, 0.5, 0.5};
  values[g] = 0;
  return values;
}

/// Constant-strain membrane with linear drilling rotation, dofs (ux, uy, rz) per node.
PlaneMatrix membrane_stiffness(const FlatTriangle& triangle, const PlaneModuli& moduli,
                               const ShellProperties& properties) {
  PlaneMatrix matrix{};
  std::array<StrainRow<plane_size>, 2> grad_x{}, grad_y{};
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t i = 0; i < 2; ++i) {
      grad_x[i][3 * a] = grad_y[i][3 * a + 1] = triangle.gradients[a][i];
    }
  }
  const double volume = triangle.area * properties.thickness;
  add_plane_energy<plane_size>(grad_x, grad_y, moduli, volume, matrix);
  for (std::size_t g = 0; g < node_count; ++g) {
    StrainRow<plane_size> drilling{};
    const auto values = edge_middle(g);
    for (std::size_t i = 0; i < plane_size; ++i) drilling[i] = (grad_x[1][i] - grad_y[0][i]) / 2;
    for (std::size_t a = 0; a < node_count; ++a) drilling[3 * a + 2] = values[a];
    add_square<plane_size>(drilling, volume / 3 * properties.drilling_factor * moduli.shear,
                           matrix);
  }
  return matrix;
}

/// Transverse shear strains where the area coordinates have `values`, dofs (uz, rx, ry) per node:
/// the field of edge functions N_a grad N_b - N_b grad N_a, whose tangential component is constant
/// along each edge.
std::array<StrainRow<plane_size>, 2> shear_at(const FlatTriangle& triangle,
                                              const std::array<double, node_count>& values) {
  std::array<StrainRow<plane_size>, 2> shear{};
  for (std::size_t a = 0; a < node_count; ++a) {
    const std::size_t b = (a + 1) % node_count;
    const auto along = edge_shear(triangle.nodes, a, b);
    for (std::size_t i = 0; i < 2; ++i) {
      const double edge_function =
          values[a] * triangle.gradients[b][i] - values[b] * triangle.gradients[a][i];
      for (std::size_t j = 0; j < plane_size; ++j) shear[i][j] += edge_function * along[j];
    }
  }
  return shear;
}

/// Transverse shear force per length and strain, reduced as the header says [N/m].
double shear_stiffness(const FlatTriangle& triangle, const PlaneModuli& moduli, double thickness) {
  const double square = thickness * thickness;
  const double h = triangle.longest_edge;
  return shear_correction * moduli.shear * thickness * square /
         (square + shear_stabilisation * h * h);
}

/// Bending of the rotation vector (ry, -rx), and transverse shear.
PlaneMatrix plate_stiffness(const FlatTriangle& triangle, const PlaneModuli& moduli,
                            double thickness) {
  PlaneMatrix matrix{};
  std::array<StrainRow<plane_size>, 2> grad_x{}, grad_y{};
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t i = 0; i < 2; ++i) {
      grad_x[i][3 * a + 2] = triangle.gradients[a][i];
      grad_y[i][3 * a + 1] = -triangle.gradients[a][i];
    }
  }
  const double square = thickness * thickness;
  add_plane_energy<plane_size>(grad_x, grad_y, moduli, triangle.area * thickness * square / 12,
                               matrix);
  const double modulus = shear_stiffness(triangle, moduli, thickness);
  for (std::size_t g = 0; g < node_count; ++g) {
    for (const auto& row : shear_at(triangle, edge_middle(g))) {
      add_square<plane_size>(row, modulus * triangle.area / 3, matrix);
    }
  }
  return matrix;
}

}  // namespace

void shell3_stiffness(std::span<const double> coordinates, const ShellProperties& properties,
                      std::span<double> stiffness) {
  const PlaneModuli moduli = checked_plane_moduli(properties);
  const FlatTriangle triangle = checked_triangle(coordinates);
  const std::array<double, node_count> heights{};
  assemble_shell(membrane_stiffness(triangle, moduli, properties),
                 plate_stiffness(triangle, moduli, properties.thickness), heights, triangle.frame,
                 stiffness);
}

CentreStrains shell3_centre_strains(std::span<const double> coordinates,
                                    const ShellProperties& properties) {
  const PlaneModuli moduli = checked_plane_moduli(properties);
  const FlatTriangle triangle = checked_triangle(coordinates);
  constexpr double third = 1.0 / node_count;
  CentreStrains strains;
  strains.frame = triangle.frame;
  strains.heights.assign(node_count, 0.0);
  set_plane_strains(triangle.gradients, strains);
  const auto shear = shear_at(triangle, {third, third, third});
  set_shear_strains(shear[0], shear[1], strains);
  strains.shear_stiffness = shear_stiffness(triangle, moduli, properties.thickness);
  return strains;
}

void shell3_lumped_mass(std::span<const double> coordinates, const ShellProperties& properties,
                        std::span<double> lumped_mass) {
  const double third = checked_triangle(coordinates).area / node_count;
  const std::array<double, node_count> areas{third, third, third};
  shell_lumped_mass(areas, properties, lumped_mass);
}

}  // namespace pounding
