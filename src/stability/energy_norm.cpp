#include "stability/energy_norm.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

/// Part that the remainder may add to |f|^2.
constexpr double slack = 0.05;
constexpr int most_iterations = 200;
constexpr double above_round_off = 1 + 1e-9;

std::vector<ScaledOperator::Term> terms_of(const LinearSystem& system, double dt) {
  std::vector<ScaledOperator::Term> terms{
      {-dt / 2 * system.damping.beta - dt * dt / 4 * system.stiffening(), &system.stiffest()}};
  if (system.extra_damping) terms.push_back({-dt / 2, system.extra_damping.get()});
  return terms;
}

double product(Vec a, Vec b) {
  double value = 0;
  POUNDING_PETSC(VecDot(a, b, &value));
  return value;
}

}  // namespace

EnergyNorm::EnergyNorm(const LinearSystem& system, double time_step, double energy_margin,
                       double work)
    : system_(system),
      scaled_(system, terms_of(system, time_step), 1 - time_step / 2 * system.damping.alpha),
      energy_margin_(energy_margin),
      iterations_left_(work / static_cast<double>(std::max<GlobalIndex>(1, system.global_dofs))) {
  POUNDING_PETSC(MatCreateVecs(scaled_.matrix(), solution_.out(), remainder_.out()));
  POUNDING_PETSC(KSPCreate(system.comm, solver_.out()));
  POUNDING_PETSC(KSPSetType(solver_.get(), KSPCG));
  POUNDING_PETSC(KSPSetOperators(solver_.get(), scaled_.matrix(), scaled_.matrix()));
  PC none = nullptr;
  POUNDING_PETSC(KSPGetPC(solver_.get(), &none));
  POUNDING_PETSC(PCSetType(none, PCNONE));
}

double EnergyNorm::bound(std::vector<double> f) {
  if (!(energy_margin_ > 0)) return std::numeric_limits<double>::infinity();
  scaled_.from_force(f);
  const VecHandle force = wrap_vector(system_, f);
  const double square = product(force.get(), force.get());
  // f^T A^-1 f is at least |f|^2 in the mass: this remainder is small enough.
  const double small_enough = std::sqrt(slack * energy_margin_);
  const int iterations = static_cast<int>(std::min<double>(most_iterations, iterations_left_));
  double found = square / energy_margin_;
  if (iterations > 0 && square > 0) {
    POUNDING_PETSC(KSPSetTolerances(solver_.get(), small_enough, 0, PETSC_DEFAULT, iterations));
    POUNDING_PETSC(KSPSolve(solver_.get(), force.get(), solution_.get()));
    int made = 0;
    POUNDING_PETSC(KSPGetIterationNumber(solver_.get(), &made));
    iterations_left_ -= made + 1;
    scaled_.apply(solution_.get(), remainder_.get());
    POUNDING_PETSC(VecAYPX(remainder_.get(), -1, force.get()));
    const double remainder = product(remainder_.get(), remainder_.get());
    found = std::min(found, product(solution_.get(), force.get()) +
                                product(solution_.get(), remainder_.get()) +
                                remainder / energy_margin_);
  }
  return std::sqrt(found) * above_round_off;
}

}  // namespace pounding
