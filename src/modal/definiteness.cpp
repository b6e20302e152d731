#include "modal/definiteness.h"

#include "common/error.h"
#include "modal/eigen_solver.h"
#include "modal/shifted_solver.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

/// Part of the largest eigenvalue by which round-off may put one below zero.
constexpr double round_off_share = 1e-11;

void require_semidefinite(const LinearSystem& system, Mat matrix, const std::string& path) {
  const MatHandle scaled = mass_scaled(system, matrix);
  double bound = 0;  // of the largest eigenvalue, by Gershgorin
  POUNDING_PETSC(MatNorm(scaled.get(), NORM_INFINITY, &bound));
  if (bound == 0) return;
  const int negative = ShiftedSolver(scaled.get(), -round_off_share * bound).eigenvalues_below();
  if (negative > 0) {
    throw UserError(path + ": not positive semidefinite, " + std::to_string(negative) +
                    " of its eigenvalues lie below zero: some motion would give energy; look for "
                    "entries with the wrong sign, or rows and columns left out");
  }
}

}  // namespace

void require_passive_matrices(const Structure& structure, const LinearSystem& system) {
  if (structure.matrices.empty()) return;
  require_semidefinite(system, system.stiffness->matrix(),
                       matrix_file(structure.matrices, "stiffness"));
  if (system.extra_damping) {
    require_semidefinite(system, system.extra_damping->matrix(),
                         matrix_file(structure.matrices, "damping"));
  }
}

}  // namespace pounding
