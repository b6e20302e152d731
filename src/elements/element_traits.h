#pragma once

/// Element matrices as the assembly asks for them: pure functions of coordinates and properties, no
/// MPI, no PETSc. Matrices are row-major in the element's own dofs, node by node: (ux, uy, uz) per
/// node, followed by (rx, ry, rz) where the element has rotations, all in global axes.

#include <optional>
#include <span>
#include <string_view>

#include "elements/element_properties.h"

namespace pounding {

// Everything that the program asks of a kind of element, in one table. A new element is its
// functions, a value of ElementType, its word and a row of the table in element_traits.cpp.

/// The elements a mesh can hold; `hex8` is the one with incompatible modes, `shell3` the triangle
/// of shell meshes; `beam` is flexible in shear, `euler_beam` is not. A `tension_bar` resists
/// stretching only, or shortening, a `yielding_bar` yields both ways. Springs act along and about
/// the global axes; those named 6 also on rotations. `soil` is no word of the option: it is under a
/// mat. In the order of the table.
enum class ElementType {
  hex8,
  hex8_full,
  beam,
  euler_beam,
  bar,
  tension_bar,
  shell4,
  shell3,
  point_mass,
  point_mass6,
  grounded_spring,
  grounded_spring6,
  spring,
  spring6,
  wedge6,
  tet4,
  soil,
  yielding_bar
};

inline constexpr int element_type_count = static_cast<int>(ElementType::yielding_bar) + 1;

/// Words of the option, separated by '|'.
inline constexpr std::string_view element_words =
    "hex8|hex8_full|wedge6|tet4|shell|beam|euler_beam|bar|point_mass|grounded_spring|spring";

/// Kind of body that an element is, on which the options of its region depend: the first four have
/// a shape and a material.
enum class ElementFamily { solid, shell, beam, bar, point_mass, grounded_spring, spring };

/// Way in which the product by elements applies an element: in rows of bricks or rectangles if it
/// has that shape, else, and triangles, by its strains; from the local stiffness of a beam; or in a
/// sparse matrix.
enum class ElementKernel { brick, rectangle, triangle, beam, sparse };

using StiffnessFunction = void (*)(std::span<const double> coordinates,
                                   const ElementProperties& properties,
                                   std::span<double> stiffness);
using LumpedMassFunction = void (*)(std::span<const double> coordinates,
                                    const ElementProperties& properties,
                                    std::span<double> lumped_mass);

/// Row of the table: everything that depends on the kind of element alone.
struct ElementTraits {
  ElementType type;
  const char* name;         ///< in the report
  std::string_view option;  ///< its word; the first row with it is the word's element
  ElementFamily family;
  ElementLayout layout;
  int gmsh_type;  ///< of its cells: 1 line, 2 triangle, 3 quadrangle, 4 tetrahedron, ...
  /// Element that cells of another shape become in a region of this one.
  std::optional<ElementType> companion;
  std::span<const ElementFace> faces;  ///< of a solid
  StiffnessFunction stiffness;
  LumpedMassFunction lumped_mass;
  ElementKernel kernel;
  int cost;                    ///< see measured_costs.h
  bool in_stiffness;           ///< K holds its stiffness
  bool scalable;               ///< mass scaling may add to its mass
  std::string_view caution{};  ///< said whenever a scene uses it
};

const ElementTraits& traits_of(ElementType type);

/// The element of a word of the option. Throws std::logic_error for a word without one.
ElementType element_of_word(std::string_view word);

/// Nodes that two elements share at least if they meet in a face: those of the smallest face of a
/// solid, one for everything else.
int shared_by_neighbours(ElementType type);

inline const char* element_name(ElementType type) {
  return traits_of(type).name;
}

inline bool is_solid(ElementType type) {
  return traits_of(type).family == ElementFamily::solid;
}

inline bool is_shell(ElementType type) {
  return traits_of(type).family == ElementFamily::shell;
}

/// Solids and shells, which can touch.
inline bool carries_faces(ElementType type) {
  return is_solid(type) || is_shell(type);
}

inline bool is_beam(ElementType type) {
  return traits_of(type).family == ElementFamily::beam;
}

inline bool is_bar(ElementType type) {
  return traits_of(type).family == ElementFamily::bar;
}

/// Solids, shells, beams and bars, which have a shape and a material.
inline bool has_extent(ElementType type) {
  return carries_faces(type) || is_beam(type) || is_bar(type);
}

/// Hexahedra and quadrangles, which may lie in rows if they are boxes or rectangles, and of which
/// those of one shape share their numbers.
inline bool has_shape(ElementType type) {
  const ElementKernel kernel = traits_of(type).kernel;
  return kernel == ElementKernel::brick || kernel == ElementKernel::rectangle;
}

inline bool is_in_stiffness(ElementType type) {
  return traits_of(type).in_stiffness;
}

/// Springs and dashpots to the ground.
inline bool is_grounded(ElementType type) {
  return traits_of(type).family == ElementFamily::grounded_spring;
}

/// Springs and dashpots, to the ground or between two nodes.
inline bool is_spring(ElementType type) {
  return is_grounded(type) || traits_of(type).family == ElementFamily::spring;
}

/// Elements of two nodes: beams, bars, springs.
inline bool joins_two_nodes(ElementType type) {
  return traits_of(type).layout.nodes == 2;
}

/// Number of the formulations: a change of the values of an element's stiffness or mass adds one,
/// so that no modal basis stored before is taken for a basis of today's matrices.
inline constexpr int element_formulations = 2;

ElementLayout element_layout(ElementType type);

/// Stiffness matrix, shape (size, size) [N/m, N, N m], and lumped mass, shape (size) [kg, kg m2],
/// of one element with node coordinates of shape (nodes, 3) [m]. Throws ElementError.
void element_matrices(ElementType type, std::span<const double> coordinates,
                      const ElementProperties& properties, std::span<double> stiffness,
                      std::span<double> lumped_mass);

/// Damping matrix of the dashpots in springs and bars, shape (size, size) [N s/m, N m s]; all zero
/// for every other element. `coordinates`: of bars.
void element_dashpots(ElementType type, std::span<const double> coordinates,
                      const ElementProperties& properties, std::span<double> damping);

/// Lumped mass alone, as `element_matrices` gives it. Throws ElementError.
void element_lumped_mass(ElementType type, std::span<const double> coordinates,
                         const ElementProperties& properties, std::span<double> lumped_mass);

}  // namespace pounding
