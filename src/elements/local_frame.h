#pragma once

/// Length and local axes of two-node elements, and the turn of their matrices to global axes.

#include <span>

#include "common/matrix3.h"
#include "common/types.h"

namespace pounding {

/// A segment from node 1 to node 2: unit direction and length [m].
struct Segment {
  Vector3 direction{};
  double length = 0;
};

/// Segment of the two nodes in `coordinates`, shape (2, 3) [m]. Throws ElementError when its length
/// is lost in the digits of the coordinates.
Segment segment_between(std::span<const double> coordinates);

/// Orthonormal local axes x, y, z as the rows of a matrix: x = `x_axis` (a unit vector), z the part
/// of `z_axis` orthogonal to x, y = z cross x. Throws ElementError when z_axis is zero or parallel
/// to x.
Matrix3 local_frame(const Vector3& x_axis, const Vector3& z_axis);

/// Turns a square matrix made of 3 x 3 blocks of local components into global ones, in place:
/// K <- T' K T with `frame` on the diagonal of T. Row-major, size a multiple of 3.
void rotate_to_global(const Matrix3& frame, std::span<double> matrix, int size);

/// Diagonal of R' diag(local) R: a lumped mass of local axes seen from the global ones, without the
/// coupling terms that a lumped mass cannot hold; the trace is kept.
Vector3 rotate_diagonal_to_global(const Matrix3& frame, const Vector3& local);

// Small dense symmetric matrices, row-major, of which the lower triangle is the one computed.

/// Copies the lower triangle of the (size, size) matrix onto the upper one: K(i, j) and K(j, i) are
/// then the same bits.
void mirror_lower_triangle(std::span<double> matrix, int size);

/// Static condensation of the dofs kept..size-1, which carry no force, of a symmetric matrix of
/// shape (size, size): K_uu - K_ua inv(K_aa) K_au in `condensed`, shape (kept, kept), both
/// triangles filled. `matrix` (lower triangle read) is overwritten. Throws ElementError when K_aa
/// is not positive definite.
void condense_last(std::span<double> matrix, int size, int kept, std::span<double> condensed);

}  // namespace pounding
