#include "stability/stability_limit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "modal/scaled_operator.h"
#include "system/mass_scaling.h"

namespace pounding {
namespace {

struct Bound {
  double value = 0;   ///< of the largest eigenvalue of A(dt)
  double excess = 0;  ///< see Lanczos
};

Bound largest_growth(const LinearSystem& system, const Mesh& mesh, double dt,
                     const EigenvalueEffort& effort) {
  const auto [alpha, beta] = system.damping;
  std::vector<ScaledOperator::Term> terms{
      {2 * dt * beta + dt * dt * system.stiffening(), &system.stiffest()}};
  if (system.extra_damping) terms.push_back({2 * dt, system.extra_damping.get()});
  const ScaledOperator scaled(system, terms, 2 * dt * alpha);
  Lanczos lanczos(system, mesh, [&scaled](Vec x, Vec y) { scaled.apply(x, y); });
  lanczos.run(effort, "the stable time step");
  return {lanczos.bound(), lanczos.excess()};
}

/// A step to begin with.
double first_step(const LinearSystem& system) {
  if (system.element_time_step_bound > 0) return system.element_time_step_bound;
  const double square = std::pow(system.element_frequency_bound, 2);
  return critical_time_step(system.damping.alpha + system.damping.beta * square,
                            system.stiffening() * square);
}

}  // namespace

double stability_limit(const LinearSystem& system, const Mesh& mesh,
                       const EigenvalueEffort& effort) {
  constexpr double tolerance = 2e-10;  // the bounds themselves are good to 1e-10
  constexpr int most_iterations = 100;
  double dt = first_step(system);
  double power = 1.5;
  double before = 0;  // logarithms of dt and of mu / 4, one iteration ago
  double growth_before = 0;
  for (int iteration = 0; std::isfinite(dt); ++iteration) {
    const Bound bound = largest_growth(system, mesh, dt, effort);
    const double part = bound.value / 4;
    const double step = std::log(dt);
    const double growth = std::log(part);
    if (std::abs(growth) <= std::max(tolerance, bound.excess / 2)) {
      return dt / std::max(part, std::sqrt(part));
    }
    if (iteration == most_iterations) {
      throw std::runtime_error("structure " + system.name +
                               ": the stable time step did not converge");
    }
    if (iteration > 0) {
      power = std::clamp((growth - growth_before) / (step - before), 1.0, 2.0);
    }
    before = step;
    growth_before = growth;
    dt = std::exp(step - growth / power);
  }
  return dt;
}

double smallest_energy_margin(const LinearSystem& system, const Mesh& mesh, double time_step,
                              const EigenvalueEffort& effort) {
  return 1 - largest_growth(system, mesh, time_step, effort).value / 4;
}

}  // namespace pounding
