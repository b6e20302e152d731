#pragma once

#include <span>
#include <stdexcept>

#include "common/types.h"

/// What the assembly asks of every element: pure functions of coordinates and properties, no MPI,
/// no PETSc. Matrices are row-major in the element's own dofs, node by node: (ux, uy, uz) per node,
/// followed by (rx, ry, rz) where the element has rotations, all in global axes.
namespace pounding {

/// An element that cannot be: inverted, zero length, an axis along the beam. The caller adds which
/// one it is.
class ElementError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Everything an element needs to know besides its coordinates; what it does not use stays 0. [SI]
struct ElementProperties {
  double young = 0;
  double poisson = 0;
  double density = 0;
  double area = 0;
  double inertia_y = 0;
  double inertia_z = 0;
  double torsion = 0;
  Vector3 z_axis{0, 0, 1};
  double thickness = 0;
  double rotary_inertia_factor = 0;   ///< of shells, see flat_shell.h
  double mass = 0;                    ///< of a point
  Vector3 rotary_inertia{0, 0, 0};    ///< of a point, about x, y, z
  std::array<double, 6> stiffness{};  ///< of a spring: along x, y, z, about x, y, z
  std::array<double, 6> dashpot{};    ///< of its dashpot, likewise [N s/m, N m s]
};

/// Number of nodes, and of components (3 or 6) at each of them.
struct ElementLayout {
  int nodes = 0;
  int components = 0;
  int size() const { return nodes * components; }
};

/// Number of the formulations: whoever changes what an element's stiffness or mass comes out as
/// adds one, so that no modal basis stored before is taken for a basis of what is computed now.
inline constexpr int element_formulations = 1;

inline constexpr int max_element_nodes = 8;
inline constexpr int max_element_size = 24;

ElementLayout element_layout(ElementType type);

/// Stiffness matrix, shape (size, size) [N/m, N, N m], and lumped mass, shape (size) [kg, kg m2],
/// of one element with node coordinates of shape (nodes, 3) [m]. Throws ElementError.
void element_matrices(ElementType type, std::span<const double> coordinates,
                      const ElementProperties& properties, std::span<double> stiffness,
                      std::span<double> lumped_mass);

/// Damping matrix of the dashpots in springs, shape (size, size) [N s/m, N m s]; all zero for every
/// other element.
void element_dashpots(ElementType type, const ElementProperties& properties,
                      std::span<double> damping);

/// The same for the lumped mass alone. Throws ElementError.
void element_lumped_mass(ElementType type, std::span<const double> coordinates,
                         const ElementProperties& properties, std::span<double> lumped_mass);

}  // namespace pounding
