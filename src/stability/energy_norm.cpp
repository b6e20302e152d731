#include "stability/energy_norm.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

/// Part that the remainder may add to |f|^2.
constexpr double slack = 0.05;
constexpr int most_iterations = 200;
constexpr double above_round_off = 1 + 1e-6;

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
      direction_(create_vector(system)),
      product_(create_vector(system)),
      energy_margin_(energy_margin),
      iterations_left_(work / static_cast<double>(std::max<GlobalIndex>(1, system.global_dofs))) {}

double EnergyNorm::bound(std::vector<double> f, double enough) {
  if (!(energy_margin_ > 0)) return std::numeric_limits<double>::infinity();
  scaled_.from_force(f);
  const VecHandle remainder = wrap_vector(system_, f);
  POUNDING_PETSC(VecCopy(remainder.get(), direction_.get()));
  double square = product(remainder.get(), remainder.get());
  // f^T A^-1 f is at least |f|^2 in the mass: this remainder is small enough.
  const double small_enough = slack * energy_margin_ * square;
  double solved = 0;  // x^T f
  double found = square / energy_margin_;
  for (int i = 0; i < most_iterations && !exhausted(); ++i) {
    if (square <= small_enough || found <= enough * enough) break;
    scaled_.apply(direction_.get(), product_.get());
    iterations_left_ -= 1;
    const double step = square / product(direction_.get(), product_.get());
    solved += step * square;
    POUNDING_PETSC(VecAXPY(remainder.get(), -step, product_.get()));
    const double next = product(remainder.get(), remainder.get());
    POUNDING_PETSC(VecAYPX(direction_.get(), next / square, remainder.get()));
    square = next;
    found = std::min(found, solved + square / energy_margin_);
  }
  return std::sqrt(found) * above_round_off;
}

}  // namespace pounding
