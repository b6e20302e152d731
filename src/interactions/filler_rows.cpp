#include "interactions/filler_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "interactions/delassus.h"
#include "interactions/interface_traces.h"

namespace pounding::interactions {
namespace {

constexpr std::size_t fields = 2;  // displacement and velocity

/// Rounds by which a bound of an eigenvalue is sharpened.
constexpr int rounds = 50;

std::vector<Constraint> filled(const Interface& interface) {
  std::vector<Constraint> found;
  std::ranges::copy_if(interface.constraints, std::back_inserter(found),
                       [](const Constraint& c) { return c.filler.area > 0; });
  return found;
}

std::vector<FillerRows::Row> rows_of(const Interface& interface) {
  std::vector<FillerRows::Row> rows;
  for (const Constraint& c : filled(interface)) rows.push_back({c.contact, c.filler});
  return rows;
}

}  // namespace

FillerRows::FillerRows(MPI_Comm comm, const Interface& interface,
                       std::span<const LinearSystem> systems, std::span<const Mesh> meshes)
    : rows_(rows_of(interface)),
      operator_(comm, filled(interface), meshes),
      structure_dofs_(dofs_by_structure(operator_, systems.size())),
      traces_(make_traces(operator_, systems, meshes, true)),
      gather_(comm, known_dofs(structure_dofs_, traces_)),
      compliance_(comm, operator_.dof_list(), traces_) {
  std::size_t known = 0;
  for (const Trace& trace : traces_) {
    first_known_.push_back(known);
    known += trace.known().size();
  }
  const std::size_t dofs = operator_.dofs();
  mine_.assign(fields * known, 0.0);
  place_impulse_.assign(known, 0.0);
  values_.assign(fields * dofs, 0.0);
  dof_impulse_.assign(dofs, 0.0);
  find_couplings(systems.size());
  count_from_rest(systems);
}

void FillerRows::find_couplings(std::size_t structures) {
  DelassusPattern pattern(operator_, compliance_);
  parts_.assign(structures, std::vector<std::vector<Coupling>>(rows_.size()));
  couplings_.resize(rows_.size());
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto dofs = operator_.row_dofs(static_cast<int>(r));
    const auto values = operator_.row_coefficients(static_cast<int>(r));
    const int row = static_cast<int>(r);
    for (const int column : pattern.coupled_with({&row, 1})) {
      const auto other = static_cast<std::size_t>(column);
      const auto other_dofs = operator_.row_dofs(static_cast<int>(other));
      const auto other_values = operator_.row_coefficients(static_cast<int>(other));
      std::map<int, double> part;  // by structure
      for (std::size_t a = 0; a < dofs.size(); ++a) {
        for (std::size_t b = 0; b < other_dofs.size(); ++b) {
          const double entry = compliance_.entry(static_cast<std::size_t>(dofs[a]),
                                                 static_cast<std::size_t>(other_dofs[b]));
          if (entry == 0) continue;
          part[operator_.dof_list()[dofs[a]].structure] += values[a] * entry * other_values[b];
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

void FillerRows::count_from_rest(std::span<const LinearSystem> systems) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    const std::vector<double> none(systems[s].lumped_mass.size(), 0.0);
    const std::vector<double>& rest = systems[s].rest_displacement;
    set_state(s, rest.empty() ? none.data() : rest.data(), none.data(), {});
  }
  if (!member()) return;
  std::vector<double> compression(rows_.size());
  std::vector<double> rate(rows_.size());
  gather(compression, rate);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    rows_[r].part.clearance += compression[r] + rows_[r].part.clearance;
  }
}

void FillerRows::set_state(std::size_t structure, const double* displacement,
                           const double* velocity, const Supports& supports) {
  double* const values = mine_.data() + fields * first_known_[structure];
  traces_[structure].apply(displacement, values, fields, supports.displacement);
  traces_[structure].apply(velocity, values + 1, fields, supports.velocity);
}

void FillerRows::gather(std::span<double> compression, std::span<double> rate) {
  gather_.gather(static_cast<int>(fields), mine_, values_);
  const std::size_t dofs = operator_.dofs();
  const std::span<const double> displacement(values_.data(), dofs);
  const std::span<const double> velocity(values_.data() + dofs, dofs);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const int row = static_cast<int>(r);
    compression[r] = -operator_.apply(row, displacement) - rows_[r].part.clearance;
    rate[r] = -operator_.apply(row, velocity);
  }
}

double FillerRows::largest_eigenvalue(std::size_t structure,
                                      std::span<const double> stiffness) const {
  // The spectral radius of |B| bounds that of B, and max_i (|B| x)_i / x_i that of |B|, x > 0.
  const std::vector<std::vector<Coupling>>& part = parts_[structure];
  std::vector<double> x(rows_.size(), 1.0);
  std::vector<double> product(rows_.size(), 0.0);
  double bound = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    double largest = 0;
    double most = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
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
    for (std::size_t r = 0; r < rows_.size(); ++r) x[r] = (x[r] + product[r] / most) / 2;
  }
  return bound;
}

void FillerRows::set_impulses(std::span<const double> impulses) {
  std::fill(dof_impulse_.begin(), dof_impulse_.end(), 0.0);
  for (std::size_t r = 0; r < impulses.size(); ++r) {
    operator_.add_transposed(static_cast<int>(r), impulses[r], dof_impulse_);
  }
}

void FillerRows::pick_impulses(std::size_t structure) {
  const std::vector<int>& known = traces_[structure].known();
  for (std::size_t k = 0; k < known.size(); ++k) {
    place_impulse_[k] = dof_impulse_[structure_dofs_[structure][known[k]]];
  }
}

void FillerRows::add_velocity_change(std::size_t structure, double* velocity) {
  pick_impulses(structure);
  traces_[structure].add_impulse(place_impulse_.data(), velocity);
}

double FillerRows::support_work(std::size_t structure, std::span<const double> velocity) {
  pick_impulses(structure);
  return traces_[structure].support_work(place_impulse_, velocity);
}

}  // namespace pounding::interactions
