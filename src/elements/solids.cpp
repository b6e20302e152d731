#include "elements/solids.h"

#include <algorithm>
#include <cstddef>
#include <sstream>

#include "common/array_reductions.h"
#include "common/matrix3.h"
#include "elements/gauss_rule.h"
#include "elements/local_frame.h"

namespace pounding {
namespace {

constexpr double smallest_relative_thickness = 1e-12;

/// Lame's constants lambda and mu [Pa].
struct LameConstants {
  double lambda = 0;
  double shear = 0;
};

LameConstants lame_constants(const ElementProperties& properties) {
  const double young = properties.young;
  const double poisson = properties.poisson;
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

/// Jacobian J(i, j) = d x_j / d xi_i from dN_a / d xi_i.
Matrix3 jacobian_of(std::span<const Vector3> nodes, std::span<const Vector3> derivatives) {
  Matrix3 result{};
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) result[i][j] += derivatives[a][i] * nodes[a][j];
    }
  }
  return result;
}

/// Thickness below which an element is flat: it drowns in the digits of its coordinates [m].
double flat_thickness(std::span<const double> coordinates) {
  return smallest_relative_thickness * largest_magnitude(coordinates);
}

/// Volume of the map: throws ElementError, naming the Jacobian's determinant, unless the thickness
/// over the largest face that the map spans is above `flat`.
void require_volume(const Matrix3& jacobian, double flat) {
  const double volume = determinant(jacobian);
  const Vector3 edges{norm(jacobian[0]), norm(jacobian[1]), norm(jacobian[2])};
  const double face = std::max({edges[0] * edges[1], edges[1] * edges[2], edges[2] * edges[0]});
  // Negated so that it also catches a value that is not a number.
  if (!(volume > flat * face)) {
    std::ostringstream message;
    message << "non-positive Jacobian " << volume;
    throw ElementError(message.str());
  }
}

/// Adds weight (lambda g_a g_b' + mu g_b g_a' + mu (g_a . g_b) I) to the blocks (a, b), b <= a, of
/// a row-major matrix of 3 dofs per gradient: the isotropic B' D B without its zeros.
void add_elastic_blocks(std::span<const Vector3> gradients, const LameConstants& lame,
                        double weight, std::span<double> matrix) {
  const std::size_t size = 3 * gradients.size();
  for (std::size_t a = 0; a < gradients.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      const Vector3& ga = gradients[a];
      const Vector3& gb = gradients[b];
      const double diagonal = lame.shear * dot(ga, gb);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          matrix[(3 * a + i) * size + 3 * b + j] +=
              weight * (lame.lambda * ga[i] * gb[j] + lame.shear * ga[j] * gb[i] +
                        (i == j ? diagonal : 0.0));
        }
      }
    }
  }
}

/// Trilinear brick. Its corners are not asked for a volume: the solid patch of MacNeal and Harder
/// has one that is folded.
struct Brick {
  static constexpr std::size_t node_count = 8;
  static constexpr std::array<Vector3, 8> points = hex_gauss_points();
  static constexpr double weight = 1;  ///< of each point

  static std::array<double, node_count> values(const Vector3& point) {
    std::array<double, node_count> result{};
    for (std::size_t a = 0; a < node_count; ++a) {
      const Vector3& s = hex_corners[a];
      result[a] = 0.125 * (1 + s[0] * point[0]) * (1 + s[1] * point[1]) * (1 + s[2] * point[2]);
    }
    return result;
  }

  /// dN_a / d(xi, eta, zeta).
  static std::array<Vector3, node_count> derivatives(const Vector3& point) {
    std::array<Vector3, node_count> result{};
    for (std::size_t a = 0; a < node_count; ++a) {
      const Vector3& s = hex_corners[a];
      const Vector3 f{1 + s[0] * point[0], 1 + s[1] * point[1], 1 + s[2] * point[2]};
      result[a] = {0.125 * s[0] * f[1] * f[2], 0.125 * s[1] * f[2] * f[0],
                   0.125 * s[2] * f[0] * f[1]};
    }
    return result;
  }
};

/// The rule (xi, eta, zeta), exact for quadratics in the triangle (0, 0), (1, 0), (0, 1) and for
/// cubics across it, -1 to 1.
constexpr std::array<Vector3, 6> wedge_points() {
  std::array<Vector3, 6> points{};
  for (std::size_t g = 0; g < points.size(); ++g) {
    points[g] = {g % 3 == 1 ? 2.0 / 3 : 1.0 / 6, g % 3 == 2 ? 2.0 / 3 : 1.0 / 6,
                 g < 3 ? -gauss_abscissa : gauss_abscissa};
  }
  return points;
}

/// Wedge: area coordinates of its triangle times linear functions across it.
struct Wedge {
  static constexpr std::size_t node_count = 6;
  static constexpr std::array<Vector3, 6> points = wedge_points();
  /// Weight of each point: a third of the reference triangle's area of one half, times one.
  static constexpr double weight = 1.0 / 6;

  static std::array<double, 3> areas(const Vector3& point) {
    return {1 - point[0] - point[1], point[0], point[1]};
  }

  static std::array<double, node_count> values(const Vector3& point) {
    const auto area = areas(point);
    std::array<double, node_count> result{};
    for (std::size_t a = 0; a < 3; ++a) {
      result[a] = area[a] * (1 - point[2]) / 2;
      result[a + 3] = area[a] * (1 + point[2]) / 2;
    }
    return result;
  }

  /// dN_a / d(xi, eta, zeta).
  static std::array<Vector3, node_count> derivatives(const Vector3& point) {
    constexpr std::array<std::array<double, 2>, 3> slopes{{{-1, -1}, {1, 0}, {0, 1}}};
    const auto area = areas(point);
    std::array<Vector3, node_count> result{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double below = (1 - point[2]) / 2;
      const double above = (1 + point[2]) / 2;
      result[a] = {slopes[a][0] * below, slopes[a][1] * below, -area[a] / 2};
      result[a + 3] = {slopes[a][0] * above, slopes[a][1] * above, area[a] / 2};
    }
    return result;
  }
};

template <typename Shape>
using Nodes = std::array<Vector3, Shape::node_count>;

template <typename Shape>
Matrix3 jacobian(const Nodes<Shape>& nodes, const Vector3& point) {
  return jacobian_of(nodes, Shape::derivatives(point));
}

/// Refuses an element without positive volume at a point of its rule.
template <typename Shape>
Nodes<Shape> checked_nodes(std::span<const double> coordinates) {
  const Nodes<Shape> nodes = relative_nodes<Shape::node_count>(coordinates);
  const double flat = flat_thickness(coordinates);
  for (const Vector3& point : Shape::points) require_volume(jacobian<Shape>(nodes, point), flat);
  return nodes;
}

/// Gradients in space of the nodal functions at a point with this Jacobian.
template <typename Shape>
Nodes<Shape> gradients_at(const Vector3& point, const Matrix3& jacobian_here) {
  const Matrix3 inverse_here = inverse(jacobian_here);
  Nodes<Shape> gradients = Shape::derivatives(point);
  for (Vector3& gradient : gradients) gradient = multiply(inverse_here, gradient);
  return gradients;
}

template <typename Shape>
void set_lumped_mass(std::span<const double> coordinates, double density,
                     std::span<double> lumped_mass) {
  const Nodes<Shape> nodes = checked_nodes<Shape>(coordinates);
  std::array<double, Shape::node_count> mass{};
  for (const Vector3& point : Shape::points) {
    const double here = density * Shape::weight * determinant(jacobian<Shape>(nodes, point));
    const auto values = Shape::values(point);
    for (std::size_t a = 0; a < mass.size(); ++a) mass[a] += here * values[a];
  }
  for (std::size_t i = 0; i < 3 * mass.size(); ++i) lumped_mass[i] = mass[i / 3];
}

/// dN_a / d(xi, eta, zeta) of a tetrahedron.
constexpr std::array<Vector3, 4> tet4_derivatives{{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Jacobian of a tetrahedron that has a positive volume.
Matrix3 tet4_jacobian(std::span<const double> coordinates) {
  const Matrix3 result = jacobian_of(relative_nodes<4>(coordinates), tet4_derivatives);
  require_volume(result, flat_thickness(coordinates));
  return result;
}

}  // namespace

void hex8_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    Hex8Formulation formulation, std::span<double> stiffness) {
  constexpr std::size_t mode_count = 3, shape_count = Brick::node_count + mode_count;
  const Nodes<Brick> nodes = checked_nodes<Brick>(coordinates);
  const LameConstants lame = lame_constants(properties);
  const bool incompatible = formulation == Hex8Formulation::incompatible;
  const std::size_t count = incompatible ? shape_count : Brick::node_count;

  const Matrix3 centre = jacobian<Brick>(nodes, {0, 0, 0});
  const Matrix3 inverse_centre = inverse(centre);
  std::array<double, 9 * shape_count * shape_count> matrix{};
  for (const Vector3& point : Brick::points) {
    const Matrix3 here = jacobian<Brick>(nodes, point);
    std::array<Vector3, shape_count> gradients{};
    std::ranges::copy(gradients_at<Brick>(point, here), gradients.begin());
    // The modes are mapped with the centre's Jacobian and scaled by det J0 / det J: their integral
    // over the element is then zero, so a constant stress does no work on them.
    const double scale = determinant(centre) / determinant(here);
    for (std::size_t m = 0; m < mode_count; ++m) {
      for (std::size_t i = 0; i < 3; ++i) {
        gradients[Brick::node_count + m][i] = -2 * point[m] * scale * inverse_centre[i][m];
      }
    }
    add_elastic_blocks({gradients.data(), count}, lame, determinant(here), matrix);
  }
  condense_last(matrix, 3 * static_cast<int>(count), 3 * static_cast<int>(Brick::node_count),
                stiffness);
}

void hex8_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass) {
  set_lumped_mass<Brick>(coordinates, properties.density, lumped_mass);
}

void wedge6_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> stiffness) {
  const Nodes<Wedge> nodes = checked_nodes<Wedge>(coordinates);
  const LameConstants lame = lame_constants(properties);
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  for (const Vector3& point : Wedge::points) {
    const Matrix3 here = jacobian<Wedge>(nodes, point);
    add_elastic_blocks(gradients_at<Wedge>(point, here), lame, Wedge::weight * determinant(here),
                       stiffness);
  }
  mirror_lower_triangle(stiffness, 3 * static_cast<int>(Wedge::node_count));
}

void wedge6_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                        std::span<double> lumped_mass) {
  set_lumped_mass<Wedge>(coordinates, properties.density, lumped_mass);
}

void tet4_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness) {
  const Matrix3 jacobian = tet4_jacobian(coordinates);
  const Matrix3 inverse_jacobian = inverse(jacobian);
  std::array<Vector3, 4> gradients = tet4_derivatives;
  for (Vector3& gradient : gradients) gradient = multiply(inverse_jacobian, gradient);
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  add_elastic_blocks(gradients, lame_constants(properties), determinant(jacobian) / 6, stiffness);
  mirror_lower_triangle(stiffness, 12);
}

void tet4_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass) {
  const double volume = determinant(tet4_jacobian(coordinates)) / 6;
  std::fill(lumped_mass.begin(), lumped_mass.end(), properties.density * volume / 4);
}

}  // namespace pounding
