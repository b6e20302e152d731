#include "modal/stability_limit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "modal/eigen_solver.h"
#include "system/critical_time_step.h"

namespace pounding {
namespace {

/// K and C scaled by the mass.
class ScaledProblem {
 public:
  ScaledProblem(const LinearSystem& system, const Mesh& mesh)
      : system_(system), mesh_(mesh), stiffness_(mass_scaled(system, system.stiffest_matrix())) {
    if (system.extra_damping) {
      extra_damping_ = mass_scaled(system, system.extra_damping->matrix());
    }
  }

  /// The largest eigenvalue of A(dt).
  LargestEigenpair largest(double dt) const {
    const auto [alpha, beta] = system_.damping;
    MatHandle matrix;
    POUNDING_PETSC(MatDuplicate(stiffness_.get(), MAT_COPY_VALUES, matrix.out()));
    POUNDING_PETSC(MatScale(matrix.get(), 2 * dt * beta + dt * dt));
    if (extra_damping_.get() != nullptr) {
      POUNDING_PETSC(MatAXPY(matrix.get(), 2 * dt, extra_damping_.get(), SUBSET_NONZERO_PATTERN));
    }
    POUNDING_PETSC(MatShift(matrix.get(), 2 * dt * alpha));
    return largest_eigenpair(system_, mesh_, matrix.get(), "the stable time step");
  }

  /// Where a motion y, |y| = 1, becomes unstable.
  double critical(std::vector<double>& y) const {
    const double square = quotient(stiffness_.get(), y);
    double rate = system_.damping.alpha + system_.damping.beta * square;
    if (extra_damping_.get() != nullptr) {
      rate += quotient(extra_damping_.get(), y);
    }
    return critical_time_step(std::max(0.0, rate), std::max(0.0, square));
  }

 private:
  /// y^T A y.
  double quotient(Mat matrix, std::vector<double>& y) const {
    const VecHandle vector = wrap_vector(system_, y);
    VecHandle product;
    double value = 0;
    POUNDING_PETSC(VecDuplicate(vector.get(), product.out()));
    POUNDING_PETSC(MatMult(matrix, vector.get(), product.get()));
    POUNDING_PETSC(VecDot(vector.get(), product.get(), &value));
    return value;
  }

  const LinearSystem& system_;
  const Mesh& mesh_;
  MatHandle stiffness_;
  MatHandle extra_damping_;
};

}  // namespace

double stability_limit(const LinearSystem& system, const Mesh& mesh) {
  constexpr double tolerance = 1e-12;
  constexpr int most_iterations = 100;
  const ScaledProblem problem(system, mesh);
  double dt = system.element_time_step_bound;  // below the limit; all that follow are above it
  for (int iteration = 0; std::isfinite(dt); ++iteration) {
    LargestEigenpair pair = problem.largest(dt);
    const double next = problem.critical(pair.vector);
    if (iteration > 0 && next >= dt * (1 - tolerance)) {
      // A(s dt) <= s A(dt) for s < 1: the largest eigenvalue there is at most 4.
      return dt * 4 / (pair.value + pair.error);
    }
    if (iteration == most_iterations) {
      throw std::runtime_error("structure " + system.name +
                               ": the stable time step did not converge");
    }
    dt = next;
  }
  return dt;
}

double smallest_energy_margin(const LinearSystem& system, const Mesh& mesh, double time_step) {
  const LargestEigenpair pair = ScaledProblem(system, mesh).largest(time_step);
  return 1 - (pair.value + pair.error) / 4;
}

}  // namespace pounding
