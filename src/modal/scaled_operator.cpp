#include "modal/scaled_operator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pounding {
namespace {

/// Diagonal of M^-1/2, 1 where the mass is coupled.
std::vector<double> mass_scale(const LinearSystem& system) {
  std::vector<double> scale(system.inverse_mass.size());
  std::transform(system.inverse_mass.begin(), system.inverse_mass.end(), scale.begin(),
                 [](double value) { return std::sqrt(value); });
  for (std::size_t n = 0; system.coupled_mass && n < system.coupled_mass->nodes().size(); ++n) {
    const NodeDofs& node = system.coupled_mass->nodes()[n];
    std::fill_n(scale.begin() + node.begin, node.count, 1.0);
  }
  return scale;
}

}  // namespace

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
  if (half == Half::plain) {
    mass.solve_half(field_.data());
  } else {
    mass.solve_transposed_half(field_.data());
  }
  mass.put(field_.data(), values);
  POUNDING_PETSC(VecRestoreArray(x, &values));
}

void ScaledOperator::apply(Vec x, Vec y) const {
  POUNDING_PETSC(VecPointwiseMult(argument_.get(), diagonal_.get(), x));
  solve_coupled(argument_.get(), Half::transposed);
  POUNDING_PETSC(VecSet(y, 0));
  for (const auto& [factor, operand] : terms_) {
    operand->apply(argument_.get(), product_.get());
    POUNDING_PETSC(VecAXPY(y, factor, product_.get()));
  }
  POUNDING_PETSC(VecPointwiseMult(y, diagonal_.get(), y));
  solve_coupled(y, Half::plain);
  POUNDING_PETSC(VecAXPY(y, shift_, x));
}

void ScaledOperator::solve(std::vector<double>& x, Half half) const {
  const VecHandle vector = wrap_vector(system_, x);
  POUNDING_PETSC(VecPointwiseMult(vector.get(), diagonal_.get(), vector.get()));
  solve_coupled(vector.get(), half);
}

void ScaledOperator::to_motion(std::vector<double>& y) const {
  solve(y, Half::transposed);
}

void ScaledOperator::from_force(std::vector<double>& f) const {
  solve(f, Half::plain);
}

}  // namespace pounding
