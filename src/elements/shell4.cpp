#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "elements/flat_shell.h"
#include "elements/gauss_rule.h"
#include "elements/local_frame.h"

namespace pounding {

namespace {

constexpr std::size_t node_count = 4;
constexpr std::size_t mode_count = 2;
constexpr std::size_t plane_size = 3 * node_count;  // dofs of the membrane, or of the plate
constexpr std::size_t membrane_size = plane_size + 2 * mode_count;

using Matrix2 = std::array<Vector2, 2>;

constexpr std::array<Vector2, node_count> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// The element laid on its mean plane.
struct FlatQuad {
  Matrix3 frame{};                           ///< local axes, in rows
  std::array<Vector2, node_count> nodes{};   ///< local x, y
  std::array<double, node_count> heights{};  ///< local z of the true nodes
};

double cross2(const Vector2& a, const Vector2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Refuses corners that are flat or re-entrant: the Jacobian is then positive everywhere.
void require_convex(const FlatQuad& quad, double negligible) {
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector2& here = quad.nodes[a];
    const Vector2& next = quad.nodes[(a + 1) % node_count];
    const Vector2& last = quad.nodes[(a + 3) % node_count];
    const Vector2 forward{next[0] - here[0], next[1] - here[1]};
    const Vector2 backward{last[0] - here[0], last[1] - here[1]};
    const double jacobian = cross2(forward, backward) / 4;
    const double edges = std::hypot(forward[0], forward[1]) + std::hypot(backward[0], backward[1]);
    // Negated so that it also catches a value that is not a number.
    if (!(jacobian > negligible * edges)) {
      std::ostringstream message;
      message << "non-positive Jacobian " << jacobian << " at corner " << a + 1
              << "; its nodes must go around a convex quadrangle";
      throw ElementError(message.str());
    }
  }
}

void require_little_warp(double height, double area) {
  const double warp = std::abs(height) / std::sqrt(area);
  if (warp <= largest_warp) return;
  std::ostringstream message;
  message << "warped: its nodes are " << std::abs(height) << " m off its mean plane, " << 100 * warp
          << " % of its size (at most " << 100 * largest_warp
          << " %); refine the mesh or use triangles";
  throw ElementError(message.str());
}

FlatQuad checked_quad(std::span<const double> coordinates) {
  const std::array<Vector3, node_count> x = relative_nodes<node_count>(coordinates);
  const Vector3 first = minus(x[2], x[0]);
  const Vector3 second = minus(x[3], x[1]);
  const Vector3 normal = cross(first, second);
  const double area = norm(normal) / 2;
  const double negligible = negligible_length(coordinates);
  if (!(area > negligible * (norm(first) + norm(second)))) {
    std::ostringstream message;
    message << "non-positive area " << area << " m2";
    throw ElementError(message.str());
  }
  FlatQuad quad;
  quad.frame[2] = normalised(normal);
  quad.frame[0] = normalised(minus(first, second));  // along xi at the centre
  quad.frame[1] = cross(quad.frame[2], quad.frame[0]);
  // The normal is orthogonal to both diagonals: heights alternate about the mean plane.
  const double height = dot(quad.frame[2], x[1]) / 2;
  for (std::size_t a = 0; a < node_count; ++a) {
    quad.nodes[a] = {dot(quad.frame[0], x[a]), dot(quad.frame[1], x[a])};
    quad.heights[a] = a % 2 == 0 ? -height : height;
  }
  require_convex(quad, negligible);
  require_little_warp(height, area);
  return quad;
}

/// Shape functions at a point: values, and derivatives in (xi, eta).
struct Shape {
  std::array<double, node_count> values{};
  std::array<Vector2, node_count> derivatives{};
};

Shape shape_at(const Vector2& point) {
  Shape shape;
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector2 f{1 + corners[a][0] * point[0], 1 + corners[a][1] * point[1]};
    shape.values[a] = 0.25 * f[0] * f[1];
    shape.derivatives[a] = {0.25 * corners[a][0] * f[1], 0.25 * corners[a][1] * f[0]};
  }
  return shape;
}

/// The map at a point: determinant of J(i, j) = d x_j / d xi_i, and its inverse.
struct Map {
  double determinant = 0;
  Matrix2 inverse{};
};

Map map_at(const FlatQuad& quad, const Shape& shape) {
  Matrix2 j{};
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < 2; ++k) j[i][k] += shape.derivatives[a][i] * quad.nodes[a][k];
    }
  }
  const double d = cross2(j[0], j[1]);
  return {d, {{{j[1][1] / d, -j[0][1] / d}, {-j[1][0] / d, j[0][0] / d}}}};
}

Vector2 to_space(const Map& map, const Vector2& natural) {
  return {map.inverse[0][0] * natural[0] + map.inverse[0][1] * natural[1],
          map.inverse[1][0] * natural[0] + map.inverse[1][1] * natural[1]};
}

/// Membrane and drilling, dofs (ux, uy, rz) per node then the two modes of ux and of uy. The
/// gradients of the modes carry the centre's map and det J0 / det J: they integrate to zero, so a
/// constant stress does no work on them.
void add_membrane(const Shape& shape, const Map& map, const Map& centre, const Vector2& point,
                  const PlaneModuli& moduli, const ShellProperties& properties,
                  std::span<double> matrix) {
  std::array<StrainRow<membrane_size>, 2> grad_x{}, grad_y{};
  StrainRow<membrane_size> drilling{};
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector2 gradient = to_space(map, shape.derivatives[a]);
    for (std::size_t i = 0; i < 2; ++i) grad_x[i][3 * a] = grad_y[i][3 * a + 1] = gradient[i];
    drilling[3 * a + 2] = shape.values[a];
  }
  const double scale = centre.determinant / map.determinant;
  for (std::size_t m = 0; m < mode_count; ++m) {
    Vector2 natural{};
    natural[m] = -2 * point[m] * scale;
    const Vector2 gradient = to_space(centre, natural);
    for (std::size_t i = 0; i < 2; ++i) {
      grad_x[i][plane_size + m] = grad_y[i][plane_size + mode_count + m] = gradient[i];
    }
  }
  for (std::size_t i = 0; i < membrane_size; ++i) drilling[i] -= (grad_y[0][i] - grad_x[1][i]) / 2;
  const double weight = properties.thickness * map.determinant;
  add_plane_energy<membrane_size>(grad_x, grad_y, moduli, weight, matrix);
  add_square<membrane_size>(drilling, weight * properties.drilling_factor * moduli.shear, matrix);
}

/// Transverse shear strains at a point, interpolated between opposite edges, dofs (uz, rx, ry) per
/// node.
std::array<StrainRow<plane_size>, 2> shear_at(const FlatQuad& quad, const Map& map,
                                              const Vector2& point) {
  std::array<StrainRow<plane_size>, 2> shear{};
  // Natural shear strains along edges, whose length in these coordinates is 2.
  const auto along = [&](std::size_t a, std::size_t b) {
    return edge_shear(quad.nodes, a, b, 0.5);
  };
  const auto below = along(0, 1), above = along(3, 2), left = along(0, 3), right = along(1, 2);
  for (std::size_t i = 0; i < plane_size; ++i) {
    const Vector2 natural{((1 - point[1]) * below[i] + (1 + point[1]) * above[i]) / 2,
                          ((1 - point[0]) * left[i] + (1 + point[0]) * right[i]) / 2};
    const Vector2 gamma = to_space(map, natural);
    shear[0][i] = gamma[0];
    shear[1][i] = gamma[1];
  }
  return shear;
}

/// Bending of the rotation vector (ry, -rx), and transverse shear, dofs (uz, rx, ry) per node.
void add_plate(const FlatQuad& quad, const Shape& shape, const Map& map, const Vector2& point,
               const PlaneModuli& moduli, double thickness, std::span<double> matrix) {
  std::array<StrainRow<plane_size>, 2> grad_x{}, grad_y{};
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector2 gradient = to_space(map, shape.derivatives[a]);
    for (std::size_t i = 0; i < 2; ++i) {
      grad_x[i][3 * a + 2] = gradient[i];
      grad_y[i][3 * a + 1] = -gradient[i];
    }
  }
  const double weight = map.determinant;
  const double inertia = thickness * thickness * thickness / 12;
  add_plane_energy<plane_size>(grad_x, grad_y, moduli, weight * inertia, matrix);
  for (const auto& row : shear_at(quad, map, point)) {
    add_square<plane_size>(row, weight * shear_correction * moduli.shear * thickness, matrix);
  }
}

Vector2 gauss_point(std::size_t g) {
  return {gauss_abscissa * corners[g][0], gauss_abscissa * corners[g][1]};
}

}  // namespace

void shell4_stiffness(std::span<const double> coordinates, const ShellProperties& properties,
                      std::span<double> stiffness) {
  const PlaneModuli moduli = checked_plane_moduli(properties);
  const FlatQuad quad = checked_quad(coordinates);
  const Map centre = map_at(quad, shape_at({0, 0}));
  std::array<double, membrane_size * membrane_size> with_modes{};
  std::array<double, plane_size * plane_size> membrane{}, plate{};
  for (std::size_t g = 0; g < node_count; ++g) {
    const Vector2 point = gauss_point(g);
    const Shape shape = shape_at(point);
    const Map map = map_at(quad, shape);
    add_membrane(shape, map, centre, point, moduli, properties, with_modes);
    add_plate(quad, shape, map, point, moduli, properties.thickness, plate);
  }
  condense_last(with_modes, membrane_size, plane_size, membrane);
  assemble_shell(membrane, plate, quad.heights, quad.frame, stiffness);
}

CentreStrains shell4_centre_strains(std::span<const double> coordinates,
                                    const ShellProperties& properties) {
  const PlaneModuli moduli = checked_plane_moduli(properties);
  const FlatQuad quad = checked_quad(coordinates);
  const Shape shape = shape_at({0, 0});
  const Map map = map_at(quad, shape);
  CentreStrains strains;
  strains.frame = quad.frame;
  strains.heights.assign(quad.heights.begin(), quad.heights.end());
  std::array<Vector2, node_count> gradients{};
  for (std::size_t a = 0; a < node_count; ++a) gradients[a] = to_space(map, shape.derivatives[a]);
  set_plane_strains(gradients, strains);
  const auto shear = shear_at(quad, map, {0, 0});
  set_shear_strains(shear[0], shear[1], strains);
  strains.shear_stiffness = shear_correction * moduli.shear * properties.thickness;
  return strains;
}

void shell4_lumped_mass(std::span<const double> coordinates, const ShellProperties& properties,
                        std::span<double> lumped_mass) {
  const FlatQuad quad = checked_quad(coordinates);
  std::array<double, node_count> areas{};
  for (std::size_t g = 0; g < node_count; ++g) {
    const Shape shape = shape_at(gauss_point(g));
    const double weight = map_at(quad, shape).determinant;
    for (std::size_t a = 0; a < node_count; ++a) areas[a] += weight * shape.values[a];
  }
  shell_lumped_mass(areas, properties, lumped_mass);
}

}  // namespace pounding
