#include "modal/eigen_solver.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/error.h"
#include "common/petsc_message.h"
#include "mesh/distributed_box.h"
#include "modal/factorisation.h"

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
  std::ostringstream text;
  text << "structure " << system.name << ": only " << found << " of " << count
       << " modes converged; its mesh is " << bounding_box(system.comm, mesh).longest_side()
       << " m long: look at the units of mesh and materials and at parts that nothing holds, or "
          "leave the modes out with -modes 0"
       << (option.empty() ? "" : "; leave option " + option + " out");
  throw UserError(text.str());
}

void require_converged(EPS solver, const LinearSystem& system, const Mesh& mesh, int count) {
  PetscInt found = 0;
  POUNDING_PETSC(EPSGetConverged(solver, &found));
  if (found < count) {
    refuse_modes(system, mesh, static_cast<int>(found), count, given_option(solver));
  }
}

MatHandle mass_scaled(const LinearSystem& system, Mat matrix) {
  std::vector<double> scale(system.inverse_mass.size());
  std::transform(system.inverse_mass.begin(), system.inverse_mass.end(), scale.begin(),
                 [](double value) { return std::sqrt(value); });
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
  for (PetscInt& count : entries) count = std::min(count, n);  // PETSc refuses more than a row has
  MatHandle matrix;
  POUNDING_PETSC(MatCreateAIJ(system.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0,
                              entries.data(), 0, nullptr, matrix.out()));
  PetscInt first = 0;
  POUNDING_PETSC(MatGetOwnershipRange(matrix.get(), &first, nullptr));
  const auto add = [&](LocalIndex i, LocalIndex j, double value) {
    POUNDING_PETSC(MatSetValue(matrix.get(), first + i, first + j, value, ADD_VALUES));
  };
  for (LocalIndex i = 0; i < n; ++i) add(i, i, system.lumped_mass[i]);
  for_each_block([&](const NodeDofs& row, const NodeDofs& column, const NodeBlock& block) {
    for (int i = 0; i < row.count; ++i) {
      for (int j = 0; j < column.count; ++j) {
        const double value = block[6 * i + j];
        add(row.begin + i, column.begin + j, value);
        if (row.begin != column.begin) add(column.begin + j, row.begin + i, value);
      }
    }
  });
  POUNDING_PETSC(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
  POUNDING_PETSC(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
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
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0) {
        const auto number = static_cast<double>(6 * mesh.file_node[node] + c);
        start[dof] = std::sin(12.9898 * number + 1);
      }
    }
  }
  POUNDING_PETSC(VecRestoreArray(vector.get(), &start));
  Vec vectors[] = {vector.get()};
  POUNDING_PETSC(EPSSetInitialSpace(solver.get(), 1, vectors));
  return solver;
}

EpsHandle solve_lowest(const LinearSystem& system, const Mesh& mesh, Mat matrix, int count,
                       Mat mass, std::vector<VecHandle>* known) {
  EpsHandle solver = create_eigen_solver(system, mesh, matrix, "lowest_", mass);
  GlobalIndex left = system.independent_dofs();
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
  require_converged(solver.get(), system, mesh, count);
  return solver;
}

}  // namespace pounding
