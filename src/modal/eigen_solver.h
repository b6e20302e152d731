#pragma once

#include <string>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "system/linear_system.h"

/// Symmetric eigenvalue problems of a structure in y = M^1/2 x, by SLEPc.
namespace pounding {

/// M^-1/2 A M^-1/2, a new matrix. Collective.
MatHandle mass_scaled(const LinearSystem& system, Mat matrix);

/// M + S, a new matrix. Collective.
MatHandle mass_matrix(const LinearSystem& system);

/// Sets an eigenvalue solver up by the user's options and solves. Throws UserError where it does
/// not work with such an option. Collective.
void solve(EPS solver);

/// Throws UserError: only `found` of `count` modes converged, with a likely cause. `option`: of the
/// solver, given by the user; empty: none. Collective.
[[noreturn]] void refuse_modes(const LinearSystem& system, const Mesh& mesh, int found, int count,
                               const std::string& option = "");

/// Throws UserError where fewer than `count` modes converged, with a likely cause. Collective.
void require_converged(EPS solver, const LinearSystem& system, const Mesh& mesh, int count);

/// Krylov-Schur on a symmetric matrix, or on A x = lambda B x where a `mass` B is given, with a
/// start vector that does not depend on the number of ranks; which eigenvalues and how many is the
/// caller's. Collective.
EpsHandle create_eigen_solver(const LinearSystem& system, const Mesh& mesh, Mat matrix,
                              const char* prefix, Mat mass = nullptr);

/// Pairs that are sought beyond those wanted: a Krylov space sees the second of two equal
/// frequencies late.
inline constexpr int looked_past = 8;

/// The shift of `solve_lowest` [1/s2].
inline constexpr double lowest_shift = -1;

/// Finds at least the `count` lowest eigenpairs of a mass-scaled stiffness, or of a stiffness and a
/// mass matrix where that is not diagonal, shift-and-invert with a Cholesky factorisation (MUMPS),
/// the shift just below zero so that free structures pass; PETSc's options with the prefix lowest_
/// hold. `known`: eigenvectors that are left out. Throws UserError if fewer converge. Collective.
EpsHandle solve_lowest(const LinearSystem& system, const Mesh& mesh, Mat matrix, int count,
                       Mat mass = nullptr, std::vector<VecHandle>* known = nullptr);

}  // namespace pounding
