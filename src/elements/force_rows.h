#pragma once

/// Forces in elements of two nodes and in grounded springs, as linear forms of their dofs.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "common/matrix3.h"
#include "elements/element_traits.h"

namespace pounding {

/// Names of the forces of an element, in their order. Of a beam N (tension above 0), Vy, Vz, T and
/// the bending moments at its two ends, My1, Mz1, My2, Mz2: they act on a section whose normal is
/// the local x, in the local axes of beam2.h, and N, Vy, Vz and T are the same all along, since
/// loads act at nodes. Of a bar N. Of springs the forces and moments along the global axes that
/// pull node 2 back to node 1, or a node back to the ground. Empty for every other element.
std::span<const std::string_view> end_force_names(ElementType type);

/// Coefficients of these forces, shape (forces, dofs of the element) [N/m, N, N m], from the
/// stiffness matrix in global axes, shape (dofs, dofs). Throws ElementError as the stiffness does.
std::vector<double> end_force_rows(ElementType type, std::span<const double> coordinates,
                                   const ElementProperties& properties,
                                   std::span<const double> stiffness);

// Forces and moments per length at the centre of a shell, as linear forms of its dofs.

/// Their names, in their order: membrane forces N11, N22, N12 [N/m], tension above 0; moments M11,
/// M22, M12 [N m/m], the stresses times their distance along axis 3 from the middle of the
/// thickness, so that M11 above 0 stretches along axis 1 the face that axis 3 points to; transverse
/// shears Q1, Q2 [N/m], which act along axis 3 on the sections whose normals are 1 and 2. In
/// equilibrium Q1 = d M11 / d1 + d M12 / d2.
inline constexpr std::array<std::string_view, 8> shell_force_names{"N11", "N22", "N12", "M11",
                                                                   "M22", "M12", "Q1",  "Q2"};

/// The axes 1, 2, 3 of these forces in the rows of a matrix, from a normal of the shell of either
/// sign, which has to be of length 1. Of a shell within 56 degrees of level 1 is the global x laid
/// on its plane and 3 points up. Of a steeper one 1 is level and points to positive x (to positive
/// y where it is along y) and 2 points up. Always 3 = 1 cross 2.
Matrix3 shell_force_axes(const Vector3& normal);

/// Coefficients of these forces, shape (8, dofs of the element) [N/m2 to N], in global axes. `type`
/// is a shell. Throws ElementError as its stiffness does.
std::vector<double> shell_force_rows(ElementType type, std::span<const double> coordinates,
                                     const ElementProperties& properties);

/// Mean strains in the same axes, shape (6, dofs of the element): e11, e22, g12, curvatures k11,
/// k22, 2 k12 [1/m, 1/m2], which are those at the centre whatever the element's shape is.
std::vector<double> shell_strain_rows(ElementType type, std::span<const double> coordinates,
                                      const ElementProperties& properties);

/// Area of a shell in its mean plane [m2].
double shell_area(ElementType type, std::span<const double> coordinates);

}  // namespace pounding
