#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "common/matrix3.h"
#include "elements/element_properties.h"

/// Parts that solid elements of isotropic linear elasticity share, whatever their shape: three
/// displacements per node, isoparametric maps.
namespace pounding {

/// Lame's constants lambda and mu [Pa].
struct LameConstants {
  double lambda = 0;
  double shear = 0;
};

LameConstants lame_constants(const ElementProperties& properties);

/// Node coordinates relative to the first node, so that an element far from the origin keeps its
/// digits.
template <std::size_t node_count>
std::array<Vector3, node_count> relative_nodes(std::span<const double> coordinates) {
  std::array<Vector3, node_count> nodes{};
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t i = 0; i < 3; ++i) nodes[a][i] = coordinates[3 * a + i] - coordinates[i];
  }
  return nodes;
}

/// Jacobian J(i, j) = d x_j / d xi_i from dN_a / d xi_i.
Matrix3 jacobian_of(std::span<const Vector3> nodes, std::span<const Vector3> derivatives);

/// Thickness below which an element is flat: it drowns in the digits of its coordinates [m].
double flat_thickness(std::span<const double> coordinates);

/// Volume of the map: throws ElementError, naming the Jacobian's determinant, unless the thickness
/// over the largest face that the map spans is above `flat`.
void require_volume(const Matrix3& jacobian, double flat);

/// Adds weight (lambda g_a g_b' + mu g_b g_a' + mu (g_a . g_b) I) to the blocks (a, b), b <= a, of
/// a row-major matrix of 3 dofs per gradient: the isotropic B' D B without its zeros.
void add_elastic_blocks(std::span<const Vector3> gradients, const LameConstants& lame,
                        double weight, std::span<double> matrix);

}  // namespace pounding
