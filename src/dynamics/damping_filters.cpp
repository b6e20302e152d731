#include "dynamics/damping_filters.h"

#include <vector>

namespace pounding {

Filters<double> filters_of(const LinearSystem& system, double time_step) {
  Filters<double> result{0, 1, {}};
  if (system.uniform_damping) {
    const double at_rest = system.uniform_damping->at_rest();
    result.passing = at_rest;
    for (const DampingFilter& filter : system.uniform_damping->filters) {
      const double c = filter.rate * time_step / 2;
      const double weight = at_rest * filter.weight;
      result.passing += weight / (1 + c);
      result.filters.at(result.count++) = {weight, (1 - c) / (1 + c), 2 * c / ((1 + c) * (1 + c))};
    }
    if (damped_about_rest(system)) result.filters.at(result.count++) = {-1, 1, 0};
  }
  return result;
}

void start_filters(const LinearSystem& system, double time_step, StructureState& state) {
  if (!system.uniform_damping) return;
  const std::vector<double> force = stiffness_times(system, state.displacement);
  const Filters<double> filters = filters_of(system, time_step);
  for (std::size_t k = 0; k < system.uniform_damping->filters.size(); ++k) {
    const double share = 1 - filters.filters[k].newest();  // Z = W - t Q of W = Q
    for (std::size_t i = 0; i < force.size(); ++i) state.filtered[k][i] = share * force[i];
  }
  const double kept = 1 - system.uniform_damping->at_rest();
  const std::vector<double> held = rest_forces(system);
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double yielded = system.rest_law_force.empty() ? 0 : system.rest_law_force[i];
    state.filtered.back()[i] = kept * (held[i] + yielded);
  }
}

}  // namespace pounding
