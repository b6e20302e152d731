#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/matrix3.h"
#include "elements/element_properties.h"

/// Flat shells: the common part of shell3 and shell4. In local axes (z normal to the plane) a node
/// moves by (ux, uy, uz) and turns by (rx, ry, rz). A fibre follows u + z ry, v - z rx; rz, the
/// drilling rotation, is tied to the rotation of the plane by the functional of Hughes and Brezzi
/// (Comput. Methods Appl. Mech. Eng. 72, 1989):
///   W = t W_p(u, v) + t^3/12 W_p(ry, -rx) + kappa G t |grad w + (ry, -rx)|^2 / 2
///       + gamma (rz - (dv/dx - du/dy)/2)^2 / 2                  per unit area, W_p in plane
///       stress, gamma = G t times the drilling factor.
namespace pounding {

/// Properties of a shell beside its coordinates. [SI]
struct ShellProperties {
  double young = 0;
  double poisson = 0;
  double density = 0;
  double thickness = 0;
  /// Rotary inertia per nodal mass is max(t^2 / 12, rotary_inertia_factor * element area). 0: the
  /// section's own; the drilling and shear cut-offs, about sqrt(12 G / rho) / t, then govern the
  /// stable time step of thin shells. 1/8: the membrane does, about 2 c / h (a step 10 to 25 times
  /// longer for h / t = 10 to 25), and the first six frequencies of a square plate in 16 x 16
  /// elements fall by 0.1 to 2.5 %.
  double rotary_inertia_factor = 0;
  double added_mass = 0;       ///< per area, as if spread through the thickness [kg/m2]
  double drilling_factor = 1;  ///< gamma / (G t), positive
};

inline constexpr double shear_correction = 5.0 / 6;  // kappa

/// Energy densities of a shell, all of the form coefficient times a squared strain / 2: in plane
/// stress, W_p = [bulk (exx + eyy)^2 + shear ((exx - eyy)^2 + gxy^2)] / 2. [N/m2 per thickness]
struct PlaneModuli {
  double bulk = 0;   ///< E / (2 (1 - nu))
  double shear = 0;  ///< G = E / (2 (1 + nu))
};

/// Throws ElementError for a thickness that is not positive.
PlaneModuli checked_plane_moduli(const ShellProperties& properties);

using Vector2 = std::array<double, 2>;

/// A linear form of an element's dofs: the value of one strain is its product with the dofs.
template <std::size_t size>
using StrainRow = std::array<double, size>;

/// So much of the shear strain along the edge from node a to node b times its length, dofs (uz, rx,
/// ry) per node: w_b - w_a + (mean rotation vector (ry, -rx)) . (x_b - x_a).
template <std::size_t nodes>
StrainRow<3 * nodes> edge_shear(const std::array<Vector2, nodes>& at, std::size_t a, std::size_t b,
                                double part = 1) {
  const double x = part * (at[b][0] - at[a][0]) / 2;
  const double y = part * (at[b][1] - at[a][1]) / 2;
  StrainRow<3 * nodes> row{};
  row[3 * a] = -part;
  row[3 * b] = part;
  row[3 * a + 1] = row[3 * b + 1] = -y;
  row[3 * a + 2] = row[3 * b + 2] = x;
  return row;
}

/// Adds coefficient * row' row to the lower triangle of a (size, size) matrix.
template <std::size_t size>
void add_square(const StrainRow<size>& row, double coefficient, std::span<double> matrix) {
  for (std::size_t i = 0; i < size; ++i) {
    const double scaled = coefficient * row[i];
    for (std::size_t j = 0; j <= i; ++j) matrix[i * size + j] += scaled * row[j];
  }
}

/// Adds the plane-stress energy of a vector field with gradients dx, dy of its x and y components,
/// times `weight`, to the lower triangle of a (size, size) matrix.
template <std::size_t size>
void add_plane_energy(const std::array<StrainRow<size>, 2>& x_gradient,
                      const std::array<StrainRow<size>, 2>& y_gradient, const PlaneModuli& moduli,
                      double weight, std::span<double> matrix) {
  StrainRow<size> sum{}, difference{}, slip{};
  for (std::size_t i = 0; i < size; ++i) {
    sum[i] = x_gradient[0][i] + y_gradient[1][i];
    difference[i] = x_gradient[0][i] - y_gradient[1][i];
    slip[i] = x_gradient[1][i] + y_gradient[0][i];
  }
  add_square<size>(sum, weight * moduli.bulk, matrix);
  add_square<size>(difference, weight * moduli.shear, matrix);
  add_square<size>(slip, weight * moduli.shear, matrix);
}

/// Stiffness of the whole shell in global axes, shape (6 nodes, 6 nodes), from its lower triangles
/// of shape (3 nodes, 3 nodes): `membrane` in (ux, uy, rz) and `plate` in (uz, rx, ry) per node of
/// the plane. `heights` are those of the nodes above the plane [m], bridged by rigid links, and
/// `frame` holds the local axes in its rows.
void assemble_shell(std::span<const double> membrane, std::span<const double> plate,
                    std::span<const double> heights, const Matrix3& frame,
                    std::span<double> stiffness);

/// Lumped mass in global axes, shape (6 nodes) [kg, kg m2], of a shell whose nodes hold the areas
/// `nodal_areas` [m2]: rho t A_node in displacement; in all three rotations that times
/// max(t^2 / 12, rotary_inertia_factor * sum of the areas).
void shell_lumped_mass(std::span<const double> nodal_areas, const ShellProperties& properties,
                       std::span<double> lumped_mass);

/// Strains of a shell at its centre, as linear forms of the dofs of the feet of its nodes in its
/// plane, shape (6 nodes) each, in local axes; and their stiffnesses.
struct CentreStrains {
  Matrix3 frame{};                                 ///< local axes, in rows
  std::vector<double> heights;                     ///< of the nodes above the plane [m]
  std::array<std::vector<double>, 3> membrane{};   ///< exx, eyy, gxy
  std::array<std::vector<double>, 3> curvature{};  ///< of (ry, -rx): kxx, kyy, 2 kxy [1/m]
  std::array<std::vector<double>, 2> shear{};      ///< dw/dx + ry, dw/dy - rx
  double shear_stiffness = 0;                      ///< shear force per length and strain [N/m]
};

/// Membrane strains and curvatures from the gradients of the shape functions, one per node [1/m].
void set_plane_strains(std::span<const std::array<double, 2>> gradients, CentreStrains& strains);

/// Transverse shear strains from forms of the dofs (uz, rx, ry) per node.
void set_shear_strains(std::span<const double> along_x, std::span<const double> along_y,
                       CentreStrains& strains);

/// Length below which an element drowns in the digits of its coordinates [m].
double negligible_length(std::span<const double> coordinates);

// Three-node flat shell, three displacements and three rotations per node, to fill the gaps of
// quadrangle meshes. Its fields on an edge are those of shell4, so patch tests pass on mixed
// meshes. Membrane: constant strain, hence stiff in in-plane bending. Plate: linear with
// transverse shear tied along the edges, MITC3 (Lee and Bathe, Comput. Struct. 82, 2004), its
// shear energy multiplied by t^2 / (t^2 + h^2 / 10), h the longest edge, which removes the locking
// of thin plates and converges with the mesh (Lyly, Stenberg and Vihinen, Comput. Methods Appl.
// Mech. Eng. 110, 1993). Drilling: see above.

/// Stiffness in global axes, shape (18, 18) [N/m, N, N m], of a shell with node coordinates of
/// shape (3, 3) [m]; uses young [Pa], poisson and thickness [m]. Symmetric to the bit. Throws
/// ElementError for a thickness or an area that is not positive.
void shell3_stiffness(std::span<const double> coordinates, const ShellProperties& properties,
                      std::span<double> stiffness);

/// Strains at the centre: those of membrane and bending are the same everywhere in it. Throws
/// ElementError as the stiffness does.
CentreStrains shell3_centre_strains(std::span<const double> coordinates,
                                    const ShellProperties& properties);

/// Lumped mass in global axes, shape (18) [kg, kg m2]: a third of the area at each node. Throws
/// ElementError as the stiffness does.
void shell3_lumped_mass(std::span<const double> coordinates, const ShellProperties& properties,
                        std::span<double> lumped_mass);

// Four-node flat shell, three displacements and three rotations per node. Nodes follow each other
// around the element. Membrane: bilinear with the quadratic modes 1 - xi^2, 1 - eta^2 condensed,
// in the form that passes the patch test (Taylor, Beresford and Wilson, Int. J. Num. Meth. Eng.
// 10, 1976). Plate: bilinear with transverse shear tied at the middle of the edges, MITC4 (Bathe
// and Dvorkin, Int. J. Num. Meth. Eng. 21, 1985). Drilling: see above. All by the 2 x 2
// Gauss rule. A warped element is projected on the plane that halves the distance between its
// diagonals; rigid links carry the nodes.

/// Largest distance of a node from the mean plane, over the square root of the area.
inline constexpr double largest_warp = 0.1;

/// Stiffness in global axes, shape (24, 24) [N/m, N, N m], of a shell with node coordinates of
/// shape (4, 3) [m]; uses young [Pa], poisson and thickness [m]. Symmetric to the bit. Throws
/// ElementError for a thickness or an area that is not positive, a corner that is re-entrant or
/// flat (nodes not in order around the element), warp above `largest_warp`.
void shell4_stiffness(std::span<const double> coordinates, const ShellProperties& properties,
                      std::span<double> stiffness);

/// Strains at the centre: the membrane and bending strains there are their means over the element,
/// whatever its shape, since the gradients of the modes vanish there. Throws ElementError as the
/// stiffness does.
CentreStrains shell4_centre_strains(std::span<const double> coordinates,
                                    const ShellProperties& properties);

/// Lumped mass in global axes, shape (24) [kg, kg m2]: the nodal area is the integral of N_a (a
/// quarter of the area of a parallelogram). Throws ElementError as the stiffness does.
void shell4_lumped_mass(std::span<const double> coordinates, const ShellProperties& properties,
                        std::span<double> lumped_mass);

}  // namespace pounding
