#include "interactions/filler_pairs.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "interactions/delassus.h"

namespace pounding::interactions {
namespace {

/// Rounds by which a bound of an eigenvalue is sharpened.
constexpr int rounds = 50;

std::vector<Constraint> filled(const Interface& interface) {
  std::vector<Constraint> found;
  std::ranges::copy_if(interface.constraints, std::back_inserter(found),
                       [](const Constraint& c) { return c.filler.area > 0; });
  return found;
}

std::vector<FillerPairs::Pair> pairs_of(const Interface& interface) {
  std::vector<FillerPairs::Pair> pairs;
  for (std::size_t r = 0; r < interface.constraints.size(); ++r) {
    const Constraint& c = interface.constraints[r];
    if (c.filler.area > 0) pairs.push_back({c.contact, r, c.filler, c.place});
  }
  return pairs;
}

/// Terms of all rows where stops give way or faces are crushed: whoever knows a contact knows their
/// forces then, which its histories and its catalogue hold.
std::vector<ConstraintTerm> terms_beside(const Interface& interface) {
  std::vector<ConstraintTerm> terms;
  if (std::ranges::none_of(interface.constraints,
                           [](const Constraint& c) { return c.filler.strikes(); })) {
    return terms;
  }
  for (const Constraint& c : interface.constraints) {
    terms.insert(terms.end(), c.terms.begin(), c.terms.end());
  }
  return terms;
}

}  // namespace

FillerPairs::FillerPairs(MPI_Comm comm, const Interface& interface,
                         std::span<const LinearSystem> systems, std::span<const Mesh> meshes)
    : pairs_(pairs_of(interface)),
      rows_(comm, filled(interface), systems, meshes, terms_beside(interface)),
      values_(fields * rows_.dofs(), 0.0),
      dof_impulse_(rows_.dofs(), 0.0) {
  find_couplings(systems.size());
  count_from_rest(systems);
}

void FillerPairs::find_couplings(std::size_t structures) {
  DelassusPattern pattern(rows_.rows(), rows_.compliance());
  parts_.assign(structures, std::vector<std::vector<Coupling>>(pairs_.size()));
  couplings_.resize(pairs_.size());
  for (std::size_t r = 0; r < pairs_.size(); ++r) {
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

void FillerPairs::count_from_rest(std::span<const LinearSystem> systems) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    const std::vector<double> none(systems[s].lumped_mass.size(), 0.0);
    const std::vector<double>& rest = systems[s].rest_displacement;
    set_displacement(s, rest.empty() ? none.data() : rest.data(), {});
    set_velocity(s, none.data(), {});
  }
  if (!rows_.member()) return;
  std::vector<double> compression(pairs_.size());
  std::vector<double> rate(pairs_.size());
  gather(compression, rate);
  for (std::size_t r = 0; r < pairs_.size(); ++r) {
    pairs_[r].part.clearance += compression[r] + pairs_[r].part.clearance;
  }
}

void FillerPairs::gather(std::span<double> compression, std::span<double> rate) {
  rows_.gather(fields, values_);
  const std::size_t dofs = rows_.dofs();
  const std::span<const double> displacement(values_.data(), dofs);
  const std::span<const double> velocity(values_.data() + dofs, dofs);
  for (std::size_t r = 0; r < pairs_.size(); ++r) {
    const int row = static_cast<int>(r);
    compression[r] = -rows_.rows().apply(row, displacement) - pairs_[r].part.clearance;
    rate[r] = -rows_.rows().apply(row, velocity);
  }
}

double FillerPairs::largest_eigenvalue(std::size_t structure,
                                       std::span<const double> stiffness) const {
  // The spectral radius of |B| bounds that of B, and max_i (|B| x)_i / x_i that of |B|, x > 0.
  const std::vector<std::vector<Coupling>>& part = parts_[structure];
  std::vector<double> x(pairs_.size(), 1.0);
  std::vector<double> product(pairs_.size(), 0.0);
  double bound = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    double largest = 0;
    double most = 0;
    for (std::size_t r = 0; r < pairs_.size(); ++r) {
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
    for (std::size_t r = 0; r < pairs_.size(); ++r) x[r] = (x[r] + product[r] / most) / 2;
  }
  return bound;
}

void FillerPairs::set_impulses(std::span<const double> impulses) {
  std::fill(dof_impulse_.begin(), dof_impulse_.end(), 0.0);
  for (std::size_t r = 0; r < impulses.size(); ++r) {
    rows_.rows().add_transposed(static_cast<int>(r), impulses[r], dof_impulse_);
  }
}

}  // namespace pounding::interactions
