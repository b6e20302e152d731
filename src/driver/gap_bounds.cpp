#include "driver/gap_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "common/progress.h"
#include "dynamics/rest_forces.h"
#include "stability/energy_norm.h"
#include "system/links.h"

namespace pounding {
namespace {

/// Products times dofs per structure: a second or two.
constexpr double work = 1e8;

/// L T over the owned coordinates, all rows.
std::vector<double> coordinate_rows(const interactions::ContactProblem& contact,
                                    std::size_t structure, const LinearSystem& system) {
  std::vector<double> rows;
  for (int row = 0; row < contact.rows(); ++row) {
    const std::vector<double> one = contact.row_force(row, structure, system.owned_dofs());
    rows.insert(rows.end(), one.begin(), one.end());
  }
  return rows;
}

GapWatch::Bound energy_bound(const interactions::ContactProblem& contact, std::size_t structure,
                             const LinearSystem& system, double time_step, double margin,
                             Progress& progress) {
  GapWatch::Bound bound;
  EnergyNorm norm(system, time_step, margin, work);
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> force = system.influence(static_cast<int>(d));
    std::transform(force.begin(), force.end(), system.lumped_mass.begin(), force.begin(),
                   std::multiplies<>());
    bound.force_norm[d] = norm.bound(std::move(force));
  }
  if (any_damped_about_rest(system)) {
    std::vector<double> load = rest_forces(system);
    for (std::size_t d = 0; d < 3; ++d) {
      const std::vector<double> iota = system.influence(static_cast<int>(d));
      for (std::size_t i = 0; i < load.size(); ++i) {
        load[i] -= system.lumped_mass[i] * iota[i] * system.gravity[d];
      }
    }
    bound.rest_norm = norm.bound(std::move(load));
  }
  // The row with the largest compliance first: its bound spares most of the others their work.
  std::vector<std::pair<double, int>> rows;
  for (int row = 0; row < contact.rows(); ++row) {
    rows.emplace_back(std::sqrt(contact.row_compliance(row, structure) / margin), row);
  }
  std::ranges::stable_sort(rows, std::greater{}, &std::pair<double, int>::first);
  std::size_t done = 0;
  for (const auto& [coarse, row] : rows) {
    progress.at("row " + std::to_string(++done) + " of " + std::to_string(rows.size()));
    if (coarse <= bound.rate_norm) break;
    const double found =
        norm.exhausted()
            ? coarse
            : norm.bound(contact.row_force(row, structure, system.owned_dofs()), bound.rate_norm);
    bound.rate_norm = std::max(bound.rate_norm, found);
  }
  return bound;
}

}  // namespace

std::vector<GapWatch::Bound> gap_bounds(MPI_Comm comm, std::span<const LinearSystem> systems,
                                        std::span<const double> energy_margins, double time_step,
                                        const interactions::ContactProblem* contact,
                                        double progress_interval) {
  std::vector<GapWatch::Bound> bounds(systems.size());
  for (std::size_t s = 0; contact != nullptr && s < bounds.size(); ++s) {
    const LinearSystem& system = systems[s];
    // The energy of soil is in that of its structure; that of one-way links in modes may be
    // negative, and nothing bounds the motion by a wave from below, supports of its own or loads,
    // nor about a rest that yielded.
    if (system.supports || system.loads || !system.rest_law_force.empty() ||
        (system.links && (system.links->hold_stiffness() || system.links->driven())) ||
        !(energy_margins[s] > 0)) {
      bounds[s].rate_norm = std::numeric_limits<double>::infinity();
      continue;
    }
    if (GapWatch::goes_by_coordinates(system)) {
      bounds[s].coordinate_rows = coordinate_rows(*contact, s, system);
      continue;
    }
    GapWatch::Bound& bound = bounds[s];
    Progress progress(comm, system.name + ": bounds of the gap rates", progress_interval);
    bound = energy_bound(*contact, s, system, time_step, energy_margins[s], progress);
    std::array<double, 5> values{bound.rate_norm, bound.rest_norm.value_or(0), bound.force_norm[0],
                                 bound.force_norm[1], bound.force_norm[2]};
    MPI_Allreduce(MPI_IN_PLACE, values.data(), 5, MPI_DOUBLE, MPI_MAX, comm);
    bound.rate_norm = values[0];
    if (bound.rest_norm) bound.rest_norm = values[1];
    std::copy(values.begin() + 2, values.end(), bound.force_norm.begin());
  }
  return bounds;
}

}  // namespace pounding
