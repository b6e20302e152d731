#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// Whether the lowest eigenpairs of a matrix are to be found without a factor: asked for, or
/// because that factor, as MUMPS expects it, would take more than 0.8 of the memory that is free.
/// Collective.
bool must_iterate(const LinearSystem& system, Mat matrix, SolverChoice choice);

/// Eigenvalue problem of a structure A x = lambda B x, whose lowest pairs an iteration seeks.
struct LowestProblem {
  const LinearSystem& system;
  const Mesh& mesh;
  Mat matrix;              ///< A, mass-scaled where there is no B; keeps the iteration's additions
  Mat mass;                ///< B, or null
  double frequency_bound;  ///< of any circular frequency of the structure [rad/s]
  /// Takes a field of displacements to the coordinates of A.
  std::function<void(std::vector<double>&)> to_coordinates;
};

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
