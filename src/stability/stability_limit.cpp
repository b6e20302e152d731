#include "stability/stability_limit.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "modal/eigen_solver.h"
#include "modal/scaled_operator.h"
#include "system/critical_time_step.h"

namespace pounding {
namespace {

/// K and C scaled by the mass.
class ScaledProblem {
 public:
  ScaledProblem(const LinearSystem& system, const Mesh& mesh)
      : system_(system), mesh_(mesh), stiffness_(system, {{1, &system.stiffest()}}) {
    if (system.extra_damping) {
      extra_damping_ = std::make_unique<ScaledOperator>(
          system, std::vector<ScaledOperator::Term>{{1, system.extra_damping.get()}});
    }
  }

  /// The largest eigenvalue of A(dt).
  LargestEigenpair largest(double dt) const {
    const auto [alpha, beta] = system_.damping;
    std::vector<ScaledOperator::Term> terms{
        {2 * dt * beta + dt * dt * system_.stiffening(), &system_.stiffest()}};
    if (system_.extra_damping) terms.push_back({2 * dt, system_.extra_damping.get()});
    const ScaledOperator scaled(system_, terms, 2 * dt * alpha);
    return largest_eigenpair(system_, mesh_, scaled.matrix(), "the stable time step");
  }

  /// Where a motion y, |y| = 1, becomes unstable.
  double critical(std::vector<double>& y) const {
    const double square = stiffness_.quotient(y);
    double rate = system_.damping.alpha + system_.damping.beta * square;
    if (extra_damping_) rate += extra_damping_->quotient(y);
    return critical_time_step(std::max(0.0, rate), system_.stiffening() * std::max(0.0, square));
  }

 private:
  const LinearSystem& system_;
  const Mesh& mesh_;
  ScaledOperator stiffness_;
  std::unique_ptr<ScaledOperator> extra_damping_;
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
