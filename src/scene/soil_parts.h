#pragma once

#include <span>
#include <vector>

#include "common/dense_matrix.h"
#include "scene/soil.h"

/// Matrices of soil as springs, dashpots and masses against motions of mats. Pure functions.
namespace pounding {

/// Adds a part, as one with an earlier one of the same motion where they are not both in series.
void add_part(SoilPart part, std::vector<SoilPart>& parts);

/// Adds the parts of a matrix without negative eigenvalues: it is the sum of d b b^T over its
/// pivots d, the largest first, each over its diagonal.
void add_parts(DenseMatrix matrix, double Impedance::*value, std::vector<SoilPart>& parts);

/// Parts against the six motions of a mat, which are the first of theirs.
std::vector<DirectedImpedance> parts_of_mat(std::span<const SoilPart> parts);

/// Springs against the motions of the mat whose motions begin with `first`, the others held.
std::vector<DirectedImpedance> own_springs(const DenseMatrix& stiffness, std::size_t first);

/// Springs between mats, of rows of the stiffness K outside of the blocks of one mat: with the
/// motion e_i of a mat, k = K_ii and c the part of row i in later mats,
///
///     e_i c^T + c e_i^T = k/2 b+ b+^T - k/2 b- b-^T,       b+- = e_i +- c / k
///
/// They have no energy of their own that is never negative; with the springs of each mat they do.
void add_springs_between(const DenseMatrix& stiffness, std::vector<SoilPart>& parts);

}  // namespace pounding
