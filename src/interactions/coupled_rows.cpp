#include "interactions/coupled_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "interactions/delassus.h"

namespace pounding::interactions {
namespace {

/// Rounds by which a bound of an eigenvalue is sharpened.
constexpr int rounds = 50;

}  // namespace

CoupledRows::CoupledRows(MPI_Comm comm, const std::vector<Constraint>& constraints,
                         std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                         std::span<const ConstraintTerm> more)
    : rows_(comm, constraints, systems, meshes, more),
      values_(fields * rows_.dofs(), 0.0),
      dof_impulse_(rows_.dofs(), 0.0) {
  find_couplings(systems.size());
  for (std::size_t s = 0; s < systems.size(); ++s) {
    const std::size_t dofs = rows_.trace(s).dofs().size();
    before_step_.emplace_back(dofs);
    velocity_.emplace_back(dofs, 0.0);
  }
}

void CoupledRows::attach(std::span<SteppedStructure* const> structures) {
  for (std::size_t s = 0; s < structures.size(); ++s) {
    structures[s]->watch(rows_.trace(s).dofs(), true);
  }
}

void CoupledRows::begin(const Step& step, std::span<const double> displacement,
                        std::span<const double> velocity) {
  for (std::size_t s = 0; s < step.structures.size(); ++s) {
    const SteppedStructure& structure = *step.structures[s];
    set_displacement(s, structure.displacement().data(), displacement);
    set_velocity(s, structure.velocity().data(), velocity);
    structure.remember(rows_.trace(s).dofs(), before_step_[s]);
  }
}

void CoupledRows::take_velocities(const Step& step, std::span<const double> supports) {
  for (std::size_t s = 0; s < step.structures.size(); ++s) {
    set_velocity(s, step.structures[s]->velocity().data(), supports);
  }
}

void CoupledRows::find_couplings(std::size_t structures) {
  DelassusPattern pattern(rows_.rows(), rows_.compliance());
  couplings_.resize(static_cast<std::size_t>(rows_.rows().rows()));
  parts_.assign(structures, std::vector<std::vector<Coupling>>(couplings_.size()));
  for (std::size_t r = 0; r < couplings_.size(); ++r) {
    const auto dofs = rows_.rows().row_dofs(static_cast<int>(r));
    const auto values = rows_.rows().row_coefficients(static_cast<int>(r));
    const int row = static_cast<int>(r);
    for (const int column : pattern.coupled_with({&row, 1})) {
      const auto other = static_cast<std::size_t>(column);
      const auto other_dofs = rows_.rows().row_dofs(static_cast<int>(other));
      const auto other_values = rows_.rows().row_coefficients(static_cast<int>(other));
      std::map<std::size_t, double> part;  // by structure
      for (std::size_t a = 0; a < dofs.size(); ++a) {
        for (std::size_t b = 0; b < other_dofs.size(); ++b) {
          const double entry = rows_.compliance().entry(static_cast<std::size_t>(dofs[a]),
                                                        static_cast<std::size_t>(other_dofs[b]));
          if (entry == 0) continue;
          part[rows_.structure_of(dofs[a])] += values[a] * entry * other_values[b];
        }
      }
      double sum = 0;
      for (const auto& [structure, compliance] : part) {
        parts_[structure][r].push_back({other, compliance});
        sum += compliance;
      }
      if (other == r) {
        couplings_[r].insert(couplings_[r].begin(), {r, std::max(0.0, sum)});
      } else if (sum != 0) {
        couplings_[r].push_back({other, sum});
      }
    }
  }
}

void CoupledRows::gather(std::span<double> elongation, std::span<double> rate) {
  rows_.gather(fields, values_);
  const std::size_t dofs = rows_.dofs();
  const std::span<const double> displacement(values_.data(), dofs);
  const std::span<const double> velocity(values_.data() + dofs, dofs);
  for (std::size_t r = 0; r < couplings_.size(); ++r) {
    const int row = static_cast<int>(r);
    elongation[r] = rows_.rows().apply(row, displacement);
    rate[r] = rows_.rows().apply(row, velocity);
  }
}

double CoupledRows::largest_eigenvalue(std::size_t structure,
                                       std::span<const double> stiffness) const {
  // The spectral radius of |B| bounds that of B, and max_i (|B| x)_i / x_i that of |B|, x > 0.
  const std::vector<std::vector<Coupling>>& part = parts_[structure];
  std::vector<double> x(couplings_.size(), 1.0);
  std::vector<double> product(couplings_.size(), 0.0);
  double bound = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    double largest = 0;
    double most = 0;
    for (std::size_t r = 0; r < couplings_.size(); ++r) {
      product[r] = 0;
      for (const Coupling& other : part[r]) {
        product[r] += std::abs(other.compliance) * std::sqrt(stiffness[r] * stiffness[other.row]) *
                      x[other.row];
      }
      largest = std::max(largest, product[r] / x[r]);
      most = std::max(most, product[r]);
    }
    bound = std::min(bound, largest);
    if (!(most > 0)) return 0;
    // Half of x stays, so that no entry dies out and none swings.
    for (std::size_t r = 0; r < couplings_.size(); ++r) x[r] = (x[r] + product[r] / most) / 2;
  }
  return bound;
}

void CoupledRows::push(const Step& step, std::span<const double> impulses) {
  std::fill(dof_impulse_.begin(), dof_impulse_.end(), 0.0);
  for (std::size_t r = 0; r < impulses.size(); ++r) {
    rows_.rows().add_transposed(static_cast<int>(r), impulses[r], dof_impulse_);
  }
  for (std::size_t s = 0; s < step.structures.size(); ++s) {
    const Trace& trace = rows_.trace(s);
    trace.restrict_to_dofs(step.structures[s]->velocity().data(), velocity_[s].data());
    rows_.add_velocity_change(s, dof_impulse_, velocity_[s].data());
    step.structures[s]->correct(trace.dofs(), before_step_[s], velocity_[s]);
  }
}

}  // namespace pounding::interactions
