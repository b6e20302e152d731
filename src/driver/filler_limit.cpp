#include "driver/filler_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "interactions/filler_rows.h"
#include "stability/stable_time_step.h"
#include "stability/structure_limits.h"

namespace pounding {
namespace {

constexpr int halvings = 200;

/// mu_s of a structure.
double margin_of(const Building& building, double time_step) {
  if (building.system->has_extra_damping()) {
    return 1 - time_step / building.limits.stable_time_step;
  }
  return energy_margin_of(*building.structure, *building.system, *building.mesh,
                          building.basis_or_null(), building.limits, time_step, {});
}

/// Whether the fillers leave the step stable.
bool is_stable(const Model& model, const std::vector<double>& eta, double time_step) {
  double sum = 0;
  for (std::size_t s = 0; s < eta.size(); ++s) {
    if (eta[s] == 0) continue;
    const double margin = margin_of(model.buildings[s], time_step);
    if (!(margin > 0)) return false;
    sum += time_step * time_step / 4 * eta[s] / margin;
  }
  return sum <= 1;
}

/// Whether a row is the one before it the other way round, of a stop that stops both ways: only one
/// of the two presses at a time.
bool acts_back(const std::vector<interactions::Constraint>& rows, std::size_t row) {
  if (row == 0 || !rows[row].filler.is_spring() || rows[row - 1].contact != rows[row].contact) {
    return false;
  }
  return std::ranges::equal(rows[row].terms, rows[row - 1].terms, [](const auto& a, const auto& b) {
    return a.structure == b.structure && a.node == b.node && a.component == b.component &&
           a.coefficient == -b.coefficient;
  });
}

}  // namespace

double filler_limit(MPI_Comm comm, const Scene& scene, const Model& model,
                    std::span<const Mesh> meshes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!interactions::has_fillers(model.interface)) return infinity;
  const interactions::FillerPairs pairs(comm, model.interface, model.systems, meshes);
  std::vector<double> stiffness;
  for (const interactions::FillerPairs::Pair& row : pairs.all()) {
    const Contact& contact = scene.contacts[row.contact];
    if (acts_back(model.interface.constraints, row.row)) {
      stiffness.push_back(0);
    } else if (contact.is_elastic()) {
      stiffness.push_back(contact.stop->stiffness);
    } else {
      stiffness.push_back(contact.filler->stiffness(row.part.thickness, row.part.area));
    }
  }
  std::vector<double> eta;
  double together = 0;
  double low = infinity;
  for (std::size_t s = 0; s < model.buildings.size(); ++s) {
    eta.push_back(pairs.largest_eigenvalue(s, stiffness));
    together += eta.back();
    if (eta.back() > 0) low = std::min(low, model.buildings[s].limits.stable_time_step);
  }
  if (!(together > 0)) return infinity;
  double high = std::min(low, 2 / std::sqrt(together));  // no margin is above 1
  if (is_stable(model, eta, high)) return high;
  low = 0;
  for (int i = 0; i < halvings && high - low > 1e-12 * high; ++i) {
    const double middle = (low + high) / 2;
    (is_stable(model, eta, middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace pounding
