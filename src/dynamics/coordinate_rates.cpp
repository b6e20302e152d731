#include "dynamics/coordinate_rates.h"

#include <algorithm>
#include <cmath>

#include "common/row_products.h"
#include "dynamics/rest_forces.h"
#include "dynamics/structure_step.h"

namespace pounding {
namespace {

/// More than rounding can take from a sum of all coordinates.
constexpr double above_round_off = 1 + 1e-9;

}  // namespace

CoordinateRates::CoordinateRates(const LinearSystem& system, std::vector<double> rows,
                                 double ground_acceleration, double time_step)
    : time_step_(time_step), filters_(filters_of(system, time_step)), rows_(std::move(rows)) {
  const std::size_t size = system.lumped_mass.size();
  const bool about_rest = damped_about_rest(system);
  rest_ = about_rest ? system.rest_displacement : std::vector<double>(size, 0.0);
  const Vector3& g = system.gravity;
  std::vector<double> stiffness(size);
  const VecHandle diagonal = wrap_vector(system, stiffness);
  POUNDING_PETSC(MatGetDiagonal(system.stiffness->matrix(), diagonal.get()));
  std::vector<double> growth(size);
  const double at_rest = system.uniform_damping ? system.uniform_damping->at_rest() : 1;
  branch_over_a_.resize(system.uniform_damping ? system.uniform_damping->filters.size() : 0);
  for (std::size_t i = 0; i < size; ++i) {
    const double m = system.lumped_mass[i];
    const double k = stiffness[i];
    const double c = system.damping.alpha * m + system.damping.beta * k;
    const double a = m - time_step / 2 * c - time_step * time_step / 4 * system.stiffening() * k;
    const auto& iota = system.generalised->influence;
    const double participation = m * std::hypot(iota[0][i], iota[1][i], iota[2][i]);
    double force = participation * (ground_acceleration + std::hypot(g[0], g[1], g[2]));
    if (about_rest) {
      const double weight = m * (iota[0][i] * g[0] + iota[1][i] * g[1] + iota[2][i] * g[2]);
      force = participation * ground_acceleration + std::abs(weight - k * rest_[i]);
    }
    stiffness_over_a_.push_back(at_rest * k / a);
    compliance_.push_back(k > 0 ? 1 / k : 0);
    for (std::size_t b = 0; b < branch_over_a_.size(); ++b) {
      branch_over_a_[b].push_back(at_rest * system.uniform_damping->filters[b].weight * k / a);
    }
    growth[i] = time_step * force / a;
  }
  for (double& value : rows_) value = std::abs(value);
  rates_.resize(size == 0 ? 0 : rows_.size() / size);
  speeds_.resize(size);
  growth_ = largest(growth);
}

double CoordinateRates::rate(const StructureState& state) {
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    const double v = state.velocity[i];
    const double mean = state.displacement[i] - time_step_ / 2 * v;
    const double moved = mean - rest_[i];
    double square = v * v + stiffness_over_a_[i] * (moved * moved);
    const double before = state.displacement[i] - time_step_ * v;  // u_{n-1}
    for (std::size_t b = 0; b < branch_over_a_.size(); ++b) {
      // Z^n = k W^{n-1} + t Q_{n-1}; W^{n-1} does not matter if k is zero.
      const auto& filter = filters_.filters[b];
      if (filter.keep == 0) continue;
      const double passed =
          (state.filtered[b][i] * compliance_[i] - filter.newest() * before) / filter.keep;
      const double branch = mean - passed;
      square += branch_over_a_[b][i] * (branch * branch);
    }
    speeds_[i] = std::sqrt(square);
  }
  return largest(speeds_);
}

double CoordinateRates::largest(const std::vector<double>& speeds) {
  multiply_rows(rows_.data(), rates_.size(), speeds.size(), speeds.data(), rates_.data(), 1);
  const double found = rates_.empty() ? 0.0 : *std::max_element(rates_.begin(), rates_.end());
  return found * above_round_off;
}

}  // namespace pounding
