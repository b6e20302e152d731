#include "modal/lowest_iteration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "modal/eigen_solver.h"
#include "modal/factorisation.h"
#include "system/factor_plan.h"

namespace pounding {
namespace {

/// Residual of a pair over its eigenvalue.
constexpr double tolerance = 1e-6;
/// Residuals below this part of the largest eigenvalue are round-off.
constexpr double round_off = 1e-13;
/// Part of the largest eigenvalue by which rigid motions are lifted off zero.
constexpr double lift = 1e-10;
/// Vectors by which the space grows at once.
constexpr PetscInt block = 4;
constexpr PetscInt most_iterations = 20000;

/// Memory [B] that no factor of so many dofs exceeds: a cube of bricks has the fullest one.
double most_factor_memory(double dofs) {
  return 250 * std::pow(dofs, 4.0 / 3);
}

/// Residual over the eigenvalue, or over `context`, where round-off is the tolerance.
PetscErrorCode error_of(EPS, PetscScalar value, PetscScalar, PetscReal residual, PetscReal* error,
                        void* context) {
  *error = residual / std::max(std::abs(value), *static_cast<const double*>(context));
  return 0;
}

}  // namespace

bool must_iterate(const LinearSystem& system, Mat matrix, SolverChoice choice) {
  if (choice != SolverChoice::automatic) return choice == SolverChoice::iterative;
  double usable = memory_for_factor();
  MPI_Allreduce(MPI_IN_PLACE, &usable, 1, MPI_DOUBLE, MPI_MIN, system.comm);
  PetscInt dofs = 0;
  POUNDING_PETSC(MatGetSize(matrix, &dofs, nullptr));
  // Ordering the rows takes its time: only where the answer is in doubt.
  return most_factor_memory(static_cast<double>(dofs)) > usable &&
         plan_factor(matrix, factor_workspace).memory > usable;
}

LowestPairs iterate_lowest(const LowestProblem& problem, int count) {
  const LinearSystem& system = problem.system;
  const double largest = problem.frequency_bound * problem.frequency_bound;
  LowestPairs result;
  result.above = lift * largest;
  if (problem.mass == nullptr) {
    POUNDING_PETSC(MatShift(problem.matrix, result.above));
  } else {
    POUNDING_PETSC(MatAXPY(problem.matrix, result.above, problem.mass, UNKNOWN_NONZERO_PATTERN));
  }
  POUNDING_PETSC(MatSetOption(problem.matrix, MAT_SPD, PETSC_TRUE));
  set_near_null_space(system, problem.mesh, problem.matrix, problem.to_coordinates);
  result.solver =
      create_eigen_solver(system, problem.mesh, problem.matrix, "lowest_", problem.mass);
  EPS solver = result.solver.get();
  POUNDING_PETSC(EPSSetType(solver, EPSGD));
  POUNDING_PETSC(EPSGDSetBlockSize(solver, block));
  POUNDING_PETSC(EPSSetDimensions(solver, count, PETSC_DEFAULT, PETSC_DEFAULT));
  POUNDING_PETSC(EPSSetWhichEigenpairs(solver, EPS_SMALLEST_REAL));
  POUNDING_PETSC(EPSSetTolerances(solver, tolerance, most_iterations));
  double least = round_off * largest / tolerance;
  POUNDING_PETSC(EPSSetConvergenceTestFunction(solver, error_of, &least, nullptr));
  ST transform = nullptr;
  KSP approximate = nullptr;
  PC multigrid = nullptr;
  POUNDING_PETSC(EPSGetST(solver, &transform));
  POUNDING_PETSC(STSetType(transform, STPRECOND));
  POUNDING_PETSC(STGetKSP(transform, &approximate));
  POUNDING_PETSC(KSPSetType(approximate, KSPPREONLY));
  POUNDING_PETSC(KSPGetPC(approximate, &multigrid));
  POUNDING_PETSC(PCSetType(multigrid, PCGAMG));
  solve(solver);
  require_converged(solver, system, problem.mesh, count);
  POUNDING_PETSC(EPSSetConvergenceTest(solver, EPS_CONV_REL));
  PetscInt iterations = 0;
  POUNDING_PETSC(EPSGetIterationNumber(solver, &iterations));
  char text[80];
  std::snprintf(text, sizeof text, "generalised Davidson with multigrid, %d iterations",
                static_cast<int>(iterations));
  result.method = text;
  return result;
}

}  // namespace pounding
