#include "interactions/delassus.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "common/integer_sets.h"
#include "common/parallel.h"

namespace pounding::interactions {
namespace {

/// The rows of G of the dofs that a rank knows and that do not move alone, one after the other.
struct KnownRows {
  std::vector<int> dof;
  std::vector<std::size_t> size;
  std::vector<int> column;
  std::vector<double> value;
};

KnownRows known_rows(std::span<const std::vector<int>> structure_dofs, std::span<Trace> traces,
                     std::span<double> diagonal) {
  KnownRows mine;
  for (std::size_t s = 0; s < traces.size(); ++s) {
    const std::vector<int>& known = traces[s].known();
    for (std::size_t a = 0; a < known.size(); ++a) {
      const int dof = structure_dofs[s][known[a]];
      diagonal[dof] = traces[s].compliance(a, a);
      if (!traces[s].moves_others(a)) continue;
      mine.dof.push_back(dof);
      mine.size.push_back(0);
      for (std::size_t b = 0; b < known.size(); ++b) {
        const double value = traces[s].compliance(a, b);
        if (value == 0) continue;
        mine.column.push_back(structure_dofs[s][known[b]]);
        mine.value.push_back(value);
        ++mine.size.back();
      }
    }
  }
  return mine;
}

}  // namespace

InterfaceCompliance::InterfaceCompliance(MPI_Comm comm,
                                         std::span<const std::vector<int>> structure_dofs,
                                         std::span<Trace> traces) {
  for (const std::vector<int>& dofs : structure_dofs) {
    diagonal_.resize(diagonal_.size() + dofs.size());
  }
  const KnownRows mine = known_rows(structure_dofs, traces, diagonal_);
  reduce_over_ranks(comm, MPI_SUM, diagonal_);
  const std::vector<int> row_dof = gather_rows(comm, mine.dof);
  const std::vector<std::size_t> size = gather_rows(comm, mine.size);
  const std::vector<int> column = gather_rows(comm, mine.column);
  const std::vector<double> value = gather_rows(comm, mine.value);
  std::vector<std::size_t> first(diagonal_.size(), 0), count(diagonal_.size(), 0);  // per dof
  for (std::size_t row = 0, next = 0; row < row_dof.size(); next += size[row++]) {
    first[row_dof[row]] = next;
    count[row_dof[row]] = size[row];
  }
  others_.reserve(diagonal_.size(), value.size());
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    for (std::size_t k = first[i]; k < first[i] + count[i]; ++k) others_.add(column[k], value[k]);
    others_.end_row();
  }
  find_groups();
}

void InterfaceCompliance::find_groups() {
  DisjointSets sets(diagonal_.size());
  for (std::size_t a = 0; a < diagonal_.size(); ++a) {
    for (const int b : moved_by(a)) sets.join(a, static_cast<std::size_t>(b));
  }
  for (std::size_t a = 0; a < diagonal_.size(); ++a) {
    group_of_.push_back(static_cast<int>(sets.root(a)));
  }
}

double InterfaceCompliance::velocity_change(std::size_t a, std::span<const double> f) const {
  if (others_.columns(a).empty()) return diagonal_[a] * f[a];
  return row_product(others_, a, f);
}

double delassus_entry(const ContactOperator& contact, const InterfaceCompliance& compliance,
                      int row, int column) {
  double sum = 0;
  const auto row_dofs = contact.row_dofs(row);
  const auto row_values = contact.row_coefficients(row);
  const auto column_dofs = contact.row_dofs(column);
  const auto column_values = contact.row_coefficients(column);
  for (std::size_t a = 0; a < row_dofs.size(); ++a) {
    for (std::size_t b = 0; b < column_dofs.size(); ++b) {
      sum += row_values[a] *
             compliance.entry(static_cast<std::size_t>(row_dofs[a]),
                              static_cast<std::size_t>(column_dofs[b])) *
             column_values[b];
    }
  }
  return sum;
}

DelassusPattern::DelassusPattern(const ContactOperator& contact,
                                 const InterfaceCompliance& compliance)
    : contact_(contact),
      compliance_(compliance),
      rows_of_(contact.dofs()),
      seen_(static_cast<std::size_t>(contact.dofs()), 0) {
  for (int row = 0; row < contact.rows(); ++row) {
    for (const int dof : contact.row_dofs(row)) rows_of_[dof].push_back(row);
  }
}

std::vector<int> DelassusPattern::coupled_with(std::span<const int> rows) {
  std::vector<int> dofs;
  const auto see = [&](int dof) {
    if (seen_[dof] == 0) dofs.push_back(dof);
    seen_[dof] = 1;
  };
  for (const int row : rows) {
    for (const int dof : contact_.row_dofs(row)) {
      see(dof);
      for (const int moved : compliance_.moved_by(static_cast<std::size_t>(dof))) see(moved);
    }
  }
  std::vector<int> coupled(rows.begin(), rows.end());
  for (const int dof : dofs) {
    coupled.insert(coupled.end(), rows_of_[dof].begin(), rows_of_[dof].end());
    seen_[dof] = 0;
  }
  std::ranges::sort(coupled);
  coupled.erase(std::unique(coupled.begin(), coupled.end()), coupled.end());
  return coupled;
}

std::vector<std::vector<int>> coupled_components(std::span<const std::vector<int>> row_dofs,
                                                 int number_of_dofs) {
  const std::size_t rows = row_dofs.size();
  DisjointSets sets(rows);
  std::vector<int> first_row_on_dof(number_of_dofs, -1);
  for (std::size_t r = 0; r < rows; ++r) {
    const int row = static_cast<int>(r);
    for (const int dof : row_dofs[r]) {
      if (dof < 0 || dof >= number_of_dofs) {
        throw std::invalid_argument("coupled_components: dof " + std::to_string(dof) + " of row " +
                                    std::to_string(row) + " is not below " +
                                    std::to_string(number_of_dofs));
      }
      int& seen = first_row_on_dof[dof];
      if (seen < 0) {
        seen = row;
        continue;
      }
      sets.join(r, static_cast<std::size_t>(seen));
    }
  }

  std::vector<std::vector<int>> groups;
  std::vector<std::size_t> group_of(rows);  // of the first row of each group
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t first = sets.root(r);
    if (first == r) {
      group_of[r] = groups.size();
      groups.emplace_back();
    }
    groups[group_of[first]].push_back(static_cast<int>(r));
  }
  return groups;
}

}  // namespace pounding::interactions
