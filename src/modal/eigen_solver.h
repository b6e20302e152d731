#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

/// Symmetric eigenvalue problems of a structure in y = M^1/2 x, by SLEPc.
namespace pounding {

/// M^1/2 x into x, by owned dof, of the lumped mass. Local.
void scale_by_root_mass(const LinearSystem& system, std::vector<double>& x);

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

/// Eigenvalue problem of a structure A x = lambda B x, whose lowest pairs are sought.
struct LowestProblem {
  const LinearSystem& system;
  const Mesh& mesh;
  Mat matrix;              ///< A, mass-scaled where there is no B; keeps additions of the iteration
  Mat mass;                ///< B, or null
  double frequency_bound;  ///< of any circular frequency of the structure [rad/s]
  /// Takes a field of displacements to the coordinates of A.
  std::function<void(std::vector<double>&)> to_coordinates;
};

/// Pairs that are sought beyond those wanted: a Krylov space sees the second of two equal
/// frequencies late.
inline constexpr int looked_past = 8;

/// The shift of `solve_lowest` [1/s2].
inline constexpr double lowest_shift = -1;

/// Finds at least the `count` lowest eigenpairs, shift-and-invert with a Cholesky factorisation
/// (MUMPS), the shift just below zero so that free structures pass; PETSc's options with the prefix
/// lowest_ hold. `known`: eigenvectors that are left out. Throws UserError if fewer converge.
/// Collective.
EpsHandle solve_lowest(const LowestProblem& problem, int count,
                       std::vector<VecHandle>* known = nullptr);

/// Workspace of a factor beyond MUMPS's own estimate [per cent].
inline constexpr int factor_workspace = 100;

/// L D L^T by MUMPS, with twice the workspace that it expects to need: of shifted matrices cut in
/// some ways it underestimates that and gives up. PETSc's options -<prefix>mat_mumps_icntl_14 (per
/// cent) and the like still have the last word. To be called before options are read. Collective.
void factorise_with_mumps(PC factorisation);

/// A = G^-1 (sum of f_i B_i) G^-T + s I as an operator, from products with the B_i alone; G G^T is
/// the mass: G = M^1/2 where it is diagonal.
class ScaledOperator {
 public:
  struct Term {
    double factor = 1;                              ///< f_i
    const stiffness::Stiffness* operand = nullptr;  ///< B_i; must outlive the operator
  };
  /// Collective.
  ScaledOperator(const LinearSystem& system, std::vector<Term> terms, double shift = 0);

  /// y = A x. Collective.
  void apply(Vec x, Vec y) const;
  /// G^-T y of a vector over the owned dofs: the motion of y.
  void to_motion(std::vector<double>& y) const { solve(y, &CoupledMass::solve_transposed_half); }
  /// G^-1 f of a force over the owned dofs.
  void from_force(std::vector<double>& f) const { solve(f, &CoupledMass::solve_half); }

 private:
  /// Applies G^-1 or G^-T, whose part of a coupled mass is `half`.
  using Half = void (CoupledMass::*)(double*) const;
  void solve_coupled(Vec x, Half half) const;
  void solve(std::vector<double>& x, Half half) const;

  const LinearSystem& system_;
  std::vector<Term> terms_;
  double shift_;
  std::vector<double> scale_;          ///< of M^-1/2, per owned dof; 1 where the mass is coupled
  mutable std::vector<double> field_;  ///< see CoupledMass
  VecHandle diagonal_;                 ///< scale_
  VecHandle argument_;                 ///< G^-T x
  VecHandle product_;                  ///< of one term
};

/// Whether the lowest eigenpairs of a matrix are to be found without a factor: asked for, or
/// because that factor, as MUMPS expects it, would take more than 0.8 of the memory that is free.
/// Collective.
bool must_iterate(const LinearSystem& system, Mat matrix, SolverChoice choice);

/// Lowest eigenpairs as their solver holds them.
struct LowestPairs {
  EpsHandle solver;
  double above = 0;    ///< excess of its eigenvalues [1/s2]
  std::string method;  ///< how they were found, where that was without a factor
};

/// Finds at least the `count` lowest eigenpairs without a factorisation: the generalised Davidson
/// method (Morgan 1990) in blocks, on A + s B, with algebraic multigrid (GAMG) that knows the
/// rigid motions; s lifts these off zero. A pair counts when its residual is 1e-6 of its eigenvalue
/// or round-off. PETSc's options with the prefix lowest_ hold. Throws UserError if fewer converge.
/// Collective.
LowestPairs iterate_lowest(const LowestProblem& problem, int count);

}  // namespace pounding
