#include "stability/stable_time_step.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "modal/eigen_solver.h"
#include "modal/reduced_system.h"
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

double damping_ratio(const Rayleigh& damping, double omega) {
  return omega > 0 ? damping.alpha / (2 * omega) + damping.beta * omega / 2 : 0;
}

double stable_time_step(const Rayleigh& damping, double omega_max, double stiffening) {
  const double square = omega_max * omega_max;
  return critical_time_step(damping.alpha + damping.beta * square, stiffening * square);
}

double energy_margin(const Rayleigh& damping, double omega_max, double time_step,
                     double stiffening) {
  const double square = omega_max * omega_max;
  return 1 - time_step / 2 * (damping.alpha + damping.beta * square) -
         time_step * time_step / 4 * stiffening * square;
}

double round_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 5);
  return std::floor(value / unit) * unit;
}

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

StructureLimits limits_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                          const ModalBasis* basis, const EigenvalueEffort& effort) {
  if (basis != nullptr) {
    return {largest_frequency(structure, *basis), stable_time_step(structure, *basis)};
  }
  StructureLimits limits{largest_frequency(system, mesh, effort), 0};
  limits.stable_time_step =
      system.has_extra_damping()
          ? stability_limit(system, mesh, effort)
          : stable_time_step(system.damping, limits.largest.omega_max, system.stiffening());
  return limits;
}

double energy_margin_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                        const ModalBasis* basis, const StructureLimits& limits, double time_step,
                        const EigenvalueEffort& effort) {
  if (basis != nullptr) return energy_margin(structure, *basis, time_step);
  return system.has_extra_damping() ? smallest_energy_margin(system, mesh, time_step, effort)
                                    : energy_margin(system.damping, limits.largest.omega_max,
                                                    time_step, system.stiffening());
}

}  // namespace pounding
