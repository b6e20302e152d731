#include "modal/modal_analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "common/parallel.h"
#include "mesh/location.h"
#include "modal/eigen_solver.h"
#include "modal/scaled_operator.h"

namespace pounding {
namespace {

constexpr std::array<const char*, 6> motion_names{"x", "y", "z", "rx", "ry", "rz"};

/// Rigid-body motions of the free nodes: rows x, y, z, and rotations about the centre of mass.
class RigidMotions {
 public:
  RigidMotions(const LinearSystem& system, const Mesh& mesh) : system_(system) {
    std::array<double, 4> sums{};
    for_each_translation(mesh, [&](std::size_t dof, int c, const Vector3& x) {
      if (c == 0) {
        const double m = system.lumped_mass[dof];
        sums[0] += m;
        for (std::size_t d = 0; d < 3; ++d) {
          sums[d + 1] += m * x[d];
        }
      }
    });
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 4, MPI_DOUBLE, MPI_SUM, system.comm);
    mass_ = sums[0];
    for (std::size_t d = 0; d < 3; ++d) {
      centre_[d] = mass_ > 0 ? sums[d + 1] / mass_ : 0;
      motions_[d] = system.influence(static_cast<int>(d));
      motions_[d + 3].assign(system.lumped_mass.size(), 0.0);
    }
    for_each_translation(mesh, [&](std::size_t dof, int c, const Vector3& x) {
      // u = e_axis x (x - centre)
      const auto component = static_cast<std::size_t>(c);
      const std::size_t next = (component + 1) % 3;
      const std::size_t last = (component + 2) % 3;
      motions_[3 + next][dof] = x[last] - centre_[last];
      motions_[3 + last][dof] = -(x[next] - centre_[next]);
    });
    for (std::size_t k = 0; k < 6; ++k) {
      inertia_[k] = weighted_square(motions_[k]);
    }
    MPI_Allreduce(MPI_IN_PLACE, inertia_.data(), 6, MPI_DOUBLE, MPI_SUM, system.comm);
  }

  double mass() const { return mass_; }
  const Vector3& centre() const { return centre_; }

  /// Effective masses of the mode y = M^1/2 phi, |y| = 1.
  Mode describe(double eigenvalue, const double* y) const {
    std::array<double, 6> participation{};
    for (std::size_t k = 0; k < 6; ++k) {
      for (std::size_t i = 0; i < motions_[k].size(); ++i) {
        participation[k] += std::sqrt(system_.lumped_mass[i]) * y[i] * motions_[k][i];
      }
    }
    MPI_Allreduce(MPI_IN_PLACE, participation.data(), 6, MPI_DOUBLE, MPI_SUM, system_.comm);
    Mode mode;
    mode.frequency = std::sqrt(std::max(0.0, eigenvalue)) / (2 * std::numbers::pi);
    for (std::size_t k = 0; k < 6; ++k) {
      mode.effective_modal_mass[k] = participation[k] * participation[k];
      const double fraction = inertia_[k] > 0 ? mode.effective_modal_mass[k] / inertia_[k] : 0;
      if (fraction > mode.direction_fraction) {
        mode.direction_fraction = fraction;
        mode.direction = motion_names[k];
      }
    }
    return mode;
  }

 private:
  template <typename Visit>
  static void for_each_translation(const Mesh& mesh, Visit&& visit) {
    for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
      for (int c = 0; c < 3; ++c) {
        const LocalIndex dof = mesh.dof(node, c);
        if (dof >= 0) {
          visit(static_cast<std::size_t>(dof), c, mesh.position(node));
        }
      }
    }
  }

  /// a^T M a on this rank.
  double weighted_square(const std::vector<double>& a) const {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += a[i] * a[i] * system_.lumped_mass[i];
    }
    return sum;
  }

  const LinearSystem& system_;
  double mass_ = 0;
  Vector3 centre_{0, 0, 0};
  std::array<std::vector<double>, 6> motions_;
  std::array<double, 6> inertia_{};
};

}  // namespace

ModalResult lowest_modes(const LinearSystem& system, const Mesh& mesh, int count) {
  const RigidMotions motions(system, mesh);
  ModalResult result;
  result.mass = motions.mass();
  result.centre_of_mass = motions.centre();
  if (count == 0) {
    return result;
  }
  const MatHandle matrix = mass_scaled(system, system.stiffest_matrix());
  const EpsHandle solver = create_eigen_solver(system, mesh, matrix.get(), "lowest_");
  const int wanted = static_cast<int>(std::min<GlobalIndex>(count, system.global_dofs));
  // A Krylov space sees the second of two equal frequencies late: look past the last one wanted.
  const int sought = static_cast<int>(std::min<GlobalIndex>(count + 8, system.global_dofs));
  POUNDING_PETSC(EPSSetDimensions(solver.get(), sought, PETSC_DEFAULT, PETSC_DEFAULT));
  POUNDING_PETSC(EPSSetWhichEigenpairs(solver.get(), EPS_TARGET_MAGNITUDE));
  POUNDING_PETSC(EPSSetTarget(solver.get(), -1.0));
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
  POUNDING_PETSC(PCSetType(factorisation, PCCHOLESKY));
  POUNDING_PETSC(PCFactorSetMatSolverType(factorisation, MATSOLVERMUMPS));
  POUNDING_PETSC(EPSSetFromOptions(solver.get()));
  POUNDING_PETSC(EPSSolve(solver.get()));
  PetscInt found = 0;
  POUNDING_PETSC(EPSGetConverged(solver.get(), &found));
  if (found < wanted) {
    throw std::runtime_error("structure " + system.name + ": only " + std::to_string(found) +
                             " of " + std::to_string(wanted) + " modes converged");
  }
  std::vector<double> storage(system.lumped_mass.size());
  const VecHandle vector = wrap_vector(system, storage);
  for (int i = 0; i < found; ++i) {
    double eigenvalue = 0;
    POUNDING_PETSC(EPSGetEigenpair(solver.get(), i, &eigenvalue, nullptr, vector.get(), nullptr));
    result.modes.push_back(motions.describe(eigenvalue, storage.data()));
  }
  std::stable_sort(result.modes.begin(), result.modes.end(),
                   [](const Mode& a, const Mode& b) { return a.frequency < b.frequency; });
  result.modes.resize(static_cast<std::size_t>(wanted));
  return result;
}

LargestFrequency largest_frequency(const LinearSystem& system, const Mesh& mesh) {
  const ScaledOperator scaled(system, {{1, &system.stiffest()}});
  const LargestEigenpair pair = largest_eigenpair(system, mesh, scaled.matrix(), "omega_max");
  LargestFrequency result;
  result.omega_max = std::sqrt(pair.value + pair.error);
  result.location = locate_largest(mesh, pair.vector);
  return result;
}

}  // namespace pounding
