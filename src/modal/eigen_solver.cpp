#include "modal/eigen_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "system/factor_plan.h"

namespace pounding {
namespace {

/// The user's option of a solver that may be to blame for its failure: " (-lowest_eps_ncv given)".
std::string given_option(EPS solver) {
  const char* prefix = nullptr;
  POUNDING_PETSC(EPSGetOptionsPrefix(solver, &prefix));
  for (const char* name : {"-eps_type", "-eps_ncv", "-eps_mpd", "-eps_max_it", "-eps_tol"}) {
    PetscBool given = PETSC_FALSE;
    POUNDING_PETSC(PetscOptionsHasName(nullptr, prefix, name, &given));
    if (given == PETSC_TRUE) return "-" + std::string(prefix) + (name + 1);
  }
  return "";
}

/// Diagonal of M^-1/2.
std::vector<double> inverse_root_mass(const LinearSystem& system) {
  std::vector<double> scale = system.inverse_mass;
  for (double& value : scale) value = std::sqrt(value);
  return scale;
}

/// Diagonal of M^-1/2, 1 where the mass is coupled.
std::vector<double> mass_scale(const LinearSystem& system) {
  std::vector<double> scale = inverse_root_mass(system);
  for (std::size_t n = 0; system.coupled_mass && n < system.coupled_mass->nodes().size(); ++n) {
    const NodeDofs& node = system.coupled_mass->nodes()[n];
    std::fill_n(scale.begin() + node.begin, node.count, 1.0);
  }
  return scale;
}

/// Residual of a pair over its eigenvalue.
constexpr double tolerance = 1e-6;
/// Residuals below this part of the largest eigenvalue are round-off.
constexpr double round_off = 1e-13;
/// Part of the largest eigenvalue by which rigid motions are lifted off zero.
constexpr double lift = 1e-10;
/// Vectors by which the space grows at once.
constexpr PetscInt grown_at_once = 4;
constexpr PetscInt most_iterations = 20000;

/// Residual over the eigenvalue, or over `context`, where round-off is the tolerance.
PetscErrorCode error_of(EPS, PetscScalar value, PetscScalar, PetscReal residual, PetscReal* error,
                        void* context) {
  *error = residual / std::max(std::abs(value), *static_cast<const double*>(context));
  return 0;
}

}  // namespace

void solve(EPS solver) {
  PetscErrorCode error = EPSSetFromOptions(solver);
  error = error != 0 ? error : EPSSolve(solver);
  const std::string option = error != 0 ? given_option(solver) : "";
  if (!option.empty()) {
    throw UserError("option " + option + ": the eigenvalue solver does not work with it (" +
                    take_petsc_message() + "); leave it out");
  }
  POUNDING_PETSC(error);
}

void refuse_modes(const LinearSystem& system, const Mesh& mesh, int found, int count,
                  const std::string& option) {
  throw UserError(sentence(
      "structure {}: only {} of {} modes converged; its mesh is {} m long: look at the units of "
      "mesh and materials and at parts that nothing holds, or leave the modes out with -modes 0[; "
      "leave option {} out]",
      {system.name, found, count, bounding_box(system.comm, mesh).longest_side(), option}));
}

void require_converged(EPS solver, const LinearSystem& system, const Mesh& mesh, int count) {
  PetscInt found = 0;
  POUNDING_PETSC(EPSGetConverged(solver, &found));
  if (found < count) {
    refuse_modes(system, mesh, static_cast<int>(found), count, given_option(solver));
  }
}

void scale_by_root_mass(const LinearSystem& system, std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= std::sqrt(system.lumped_mass[i]);
}

MatHandle mass_scaled(const LinearSystem& system, Mat matrix) {
  std::vector<double> scale = inverse_root_mass(system);
  const VecHandle diagonal = wrap_vector(system, scale);
  MatHandle scaled;
  POUNDING_PETSC(MatDuplicate(matrix, MAT_COPY_VALUES, scaled.out()));
  POUNDING_PETSC(MatDiagonalScale(scaled.get(), diagonal.get(), diagonal.get()));
  POUNDING_PETSC(MatSetOption(scaled.get(), MAT_SYMMETRIC, PETSC_TRUE));
  return scaled;
}

MatHandle mass_matrix(const LinearSystem& system) {
  const LocalIndex n = system.owned_dofs();
  std::vector<PetscInt> entries(n, 1);
  const auto for_each_block = [&](const auto& visit) {
    if (!system.coupled_mass) return;
    const std::vector<NodeDofs>& nodes = system.coupled_mass->added().nodes;
    for (const auto& [pair, block] : system.coupled_mass->added().blocks) {
      visit(nodes[pair[0]], nodes[pair[1]], block);
    }
  };
  for_each_block([&](const NodeDofs& row, const NodeDofs& column, const NodeBlock&) {
    for (int i = 0; i < row.count; ++i) entries[row.begin + i] += column.count;
    for (int j = 0; j < column.count && row.begin != column.begin; ++j) {
      entries[column.begin + j] += row.count;
    }
  });
  std::vector<AddedMass::Entry> wet;
  for (const AddedMass& water : system.waters()) {
    for (const auto& entry : water.mass_entries()) {
      wet.push_back(entry);
      ++entries[entry.row];
    }
  }
  for (PetscInt& count : entries) count = std::min(count, n);  // PETSc refuses more than a row has
  MatHandle matrix;
  POUNDING_PETSC(MatCreateAIJ(system.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0,
                              entries.data(), 0, nullptr, matrix.out()));
  const PetscInt first = first_row(matrix.get());
  const auto add = [&](LocalIndex i, LocalIndex j, double value) {
    POUNDING_PETSC(MatSetValue(matrix.get(), first + i, first + j, value, ADD_VALUES));
  };
  for (LocalIndex i = 0; i < n; ++i) add(i, i, system.lumped_mass[i]);
  for (const auto& [row, column, value] : wet) add(row, column, value);
  for_each_block([&](const NodeDofs& row, const NodeDofs& column, const NodeBlock& block) {
    for (int i = 0; i < row.count; ++i) {
      for (int j = 0; j < column.count; ++j) {
        const double value = block[6 * i + j];
        add(row.begin + i, column.begin + j, value);
        if (row.begin != column.begin) add(column.begin + j, row.begin + i, value);
      }
    }
  });
  assemble(matrix.get());
  POUNDING_PETSC(MatSetOption(matrix.get(), MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

EpsHandle create_eigen_solver(const LinearSystem& system, const Mesh& mesh, Mat matrix,
                              const char* prefix, Mat mass) {
  EpsHandle solver;
  POUNDING_PETSC(EPSCreate(system.comm, solver.out()));
  POUNDING_PETSC(EPSSetOptionsPrefix(solver.get(), prefix));
  POUNDING_PETSC(EPSSetOperators(solver.get(), matrix, mass));
  POUNDING_PETSC(EPSSetProblemType(solver.get(), mass == nullptr ? EPS_HEP : EPS_GHEP));
  POUNDING_PETSC(EPSSetType(solver.get(), EPSKRYLOVSCHUR));
  VecHandle vector;
  double* start = nullptr;
  POUNDING_PETSC(MatCreateVecs(matrix, vector.out(), nullptr));
  POUNDING_PETSC(VecGetArray(vector.get(), &start));
  for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex node, int c) {
    start[dof] = std::sin(12.9898 * static_cast<double>(6 * mesh.file_node[node] + c) + 1);
  });
  POUNDING_PETSC(VecRestoreArray(vector.get(), &start));
  Vec vectors[] = {vector.get()};
  POUNDING_PETSC(EPSSetInitialSpace(solver.get(), 1, vectors));
  return solver;
}

EpsHandle solve_lowest(const LowestProblem& problem, int count, std::vector<VecHandle>* known) {
  EpsHandle solver =
      create_eigen_solver(problem.system, problem.mesh, problem.matrix, "lowest_", problem.mass);
  GlobalIndex left = problem.system.independent_dofs();
  if (known != nullptr) {
    std::vector<Vec> vectors;
    for (const VecHandle& vector : *known) vectors.push_back(vector.get());
    POUNDING_PETSC(
        EPSSetDeflationSpace(solver.get(), static_cast<PetscInt>(vectors.size()), vectors.data()));
    left -= static_cast<GlobalIndex>(vectors.size());
  }
  const int sought = static_cast<int>(std::min<GlobalIndex>(count + looked_past, left));
  // Many are found in portions: the projected problem stays small.
  constexpr int portion = 100;
  POUNDING_PETSC(EPSSetDimensions(solver.get(), sought, PETSC_DEFAULT,
                                  sought > portion ? portion : PETSC_DEFAULT));
  POUNDING_PETSC(EPSSetWhichEigenpairs(solver.get(), EPS_TARGET_MAGNITUDE));
  POUNDING_PETSC(EPSSetTarget(solver.get(), lowest_shift));
  POUNDING_PETSC(EPSSetTolerances(solver.get(), 1e-10, PETSC_DEFAULT));
  ST transform = nullptr;
  KSP factorised = nullptr;
  PC factorisation = nullptr;
  POUNDING_PETSC(EPSGetST(solver.get(), &transform));
  POUNDING_PETSC(STSetType(transform, STSINVERT));
  POUNDING_PETSC(STSetMatMode(transform, ST_MATMODE_INPLACE));  // no second copy to shift
  POUNDING_PETSC(STGetKSP(transform, &factorised));
  POUNDING_PETSC(KSPSetType(factorised, KSPPREONLY));
  POUNDING_PETSC(KSPGetPC(factorised, &factorisation));
  factorise_with_mumps(factorisation);
  solve(solver.get());
  require_converged(solver.get(), problem.system, problem.mesh, count);
  return solver;
}

void factorise_with_mumps(PC factorisation) {
  POUNDING_PETSC(PCSetType(factorisation, PCCHOLESKY));
  POUNDING_PETSC(PCFactorSetMatSolverType(factorisation, MATSOLVERMUMPS));
  const char* prefix = nullptr;
  POUNDING_PETSC(PCGetOptionsPrefix(factorisation, &prefix));
  const std::string option =
      std::string("-") + (prefix == nullptr ? "" : prefix) + "mat_mumps_icntl_14";
  PetscBool given = PETSC_FALSE;
  POUNDING_PETSC(PetscOptionsHasName(nullptr, nullptr, option.c_str(), &given));
  if (given == PETSC_FALSE) {
    POUNDING_PETSC(
        PetscOptionsSetValue(nullptr, option.c_str(), std::to_string(factor_workspace).c_str()));
  }
}

ScaledOperator::ScaledOperator(const LinearSystem& system, std::vector<Term> terms, double shift)
    : system_(system),
      terms_(std::move(terms)),
      shift_(shift),
      scale_(mass_scale(system)),
      field_(system.coupled_mass ? system.coupled_mass->field_size() : 0),
      diagonal_(wrap_vector(system, scale_)) {
  POUNDING_PETSC(VecDuplicate(diagonal_.get(), argument_.out()));
  POUNDING_PETSC(VecDuplicate(diagonal_.get(), product_.out()));
}

void ScaledOperator::solve_coupled(Vec x, Half half) const {
  if (!system_.coupled_mass) return;
  const CoupledMass& mass = *system_.coupled_mass;
  double* values = nullptr;
  POUNDING_PETSC(VecGetArray(x, &values));
  mass.take(values, field_.data());
  (mass.*half)(field_.data());
  mass.put(field_.data(), values);
  POUNDING_PETSC(VecRestoreArray(x, &values));
}

void ScaledOperator::apply(Vec x, Vec y) const {
  POUNDING_PETSC(VecPointwiseMult(argument_.get(), diagonal_.get(), x));
  solve_coupled(argument_.get(), &CoupledMass::solve_transposed_half);
  POUNDING_PETSC(VecSet(y, 0));
  for (const auto& [factor, operand] : terms_) {
    operand->apply(argument_.get(), product_.get());
    POUNDING_PETSC(VecAXPY(y, factor, product_.get()));
  }
  POUNDING_PETSC(VecPointwiseMult(y, diagonal_.get(), y));
  solve_coupled(y, &CoupledMass::solve_half);
  POUNDING_PETSC(VecAXPY(y, shift_, x));
}

void ScaledOperator::solve(std::vector<double>& x, Half half) const {
  const VecHandle vector = wrap_vector(system_, x);
  POUNDING_PETSC(VecPointwiseMult(vector.get(), diagonal_.get(), vector.get()));
  solve_coupled(vector.get(), half);
}

bool must_iterate(const LinearSystem& system, Mat matrix, SolverChoice choice) {
  if (choice != SolverChoice::automatic) return choice == SolverChoice::iterative;
  double usable = memory_for_factor();
  reduce_over_ranks(system.comm, MPI_MIN, usable);
  PetscInt dofs = 0;
  POUNDING_PETSC(MatGetSize(matrix, &dofs, nullptr));
  // No factor of so many dofs exceeds this memory [B]: a cube of bricks has the fullest one.
  const double most = 250 * std::pow(static_cast<double>(dofs), 4.0 / 3);
  // Ordering the rows takes its time: only where the answer is in doubt.
  return most > usable && plan_factor(matrix, factor_workspace).memory > usable;
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
  POUNDING_PETSC(EPSGDSetBlockSize(solver, grown_at_once));
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
  result.method = sentence("generalised Davidson with multigrid, {} iterations", {iterations});
  return result;
}

}  // namespace pounding
