#pragma once

#include <span>

#include "elements/element_traits.h"

/// Geometric stiffness of beams and bars, by their axial force: pure functions of coordinates,
/// matrices as in element_traits.h.
namespace pounding {

/// Whether an element of this type has an axial force that turns with it: beams, and bars that
/// stretch and shrink alike.
bool has_axial_force(ElementType type);

/// Axial force N [N] of a beam or bar, tension above 0, with the displacements of its nodes, shape
/// (2, 3) [m].
double axial_force(std::span<const double> coordinates, const ElementProperties& properties,
                   std::span<const double> displacements);

/// Adds the geometric stiffness of a beam or bar under an axial force N, tension above 0: of a bar
/// N / L (I - t t^T), of a beam the consistent matrix of its deflections under forces at its ends,
/// in each plane, with a = 36 + 60 Phi + 30 Phi^2, b = (4 + 5 Phi + 5/2 Phi^2) L^2,
/// c = (1 + 5 Phi + 5/2 Phi^2) L^2, and Phi of beam2.h
///
///     N / (30 L (1 + Phi)^2) [a  3L  -a  3L;  3L  b  -3L  -c;  -a  -3L  a  -3L;  3L  -c  -3L  b]
///
/// (J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968). Twist is left as it is.
void add_geometric_stiffness(ElementType type, std::span<const double> coordinates,
                             const ElementProperties& properties, double axial_force,
                             std::span<double> stiffness);

}  // namespace pounding
