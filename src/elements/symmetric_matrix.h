#pragma once

#include <span>

/// Small dense symmetric matrices, row-major, of which the lower triangle is the one computed.
namespace pounding {

/// Copies the lower triangle of the (size, size) matrix onto the upper one: K(i, j) and K(j, i) are
/// then the same bits.
void mirror_lower_triangle(std::span<double> matrix, int size);

/// Static condensation of the dofs kept..size-1, which carry no force, of a symmetric matrix of
/// shape (size, size): K_uu - K_ua inv(K_aa) K_au in `condensed`, shape (kept, kept), both
/// triangles filled. `matrix` (lower triangle read) is overwritten. Throws ElementError when K_aa
/// is not positive definite.
void condense_last(std::span<double> matrix, int size, int kept, std::span<double> condensed);

}  // namespace pounding
