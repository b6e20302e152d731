#include "system/square_matrix.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/facts.h"

namespace pounding {
namespace {

/// Part of the largest entry, and of a bound, that is taken for round-off.
constexpr double round_off = 1e-9;

/// Sorts by column; entries of one column become their sum.
void merge(std::vector<SquareMatrix::Entry>& entries) {
  std::ranges::stable_sort(entries, {}, &SquareMatrix::Entry::first);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (kept > 0 && entries[kept - 1].first == entries[i].first) {
      entries[kept - 1].second += entries[i].second;
    } else {
      entries[kept++] = entries[i];
    }
  }
  entries.resize(kept);
}

}  // namespace

SquareMatrix::SquareMatrix(std::string path, const std::vector<PetscInt>& owned_dof,
                           const std::vector<PetscInt>& number, std::size_t owned_dofs)
    : path_(std::move(path)),
      owned_dof_(owned_dof),
      number_(number),
      rows_(owned_dofs),
      mirrored_(owned_dofs),
      diagonal_(number.size(), 0.0) {}

void SquareMatrix::add(const MatrixEntry& entry) {
  const std::size_t row = entry.row;
  const std::size_t column = entry.column;
  if (number_[row] < 0 || number_[column] < 0) return;
  if (owned_dof_[row] >= 0) rows_[owned_dof_[row]].emplace_back(entry.column, entry.value);
  if (owned_dof_[column] >= 0) mirrored_[owned_dof_[column]].emplace_back(entry.row, entry.value);
  diagonal_[row] += row == column ? entry.value : 0;
}

void SquareMatrix::finish() {
  for (auto* lists : {&rows_, &mirrored_}) {
    for (std::vector<Entry>& list : *lists) {
      merge(list);
      for (const Entry& entry : list) largest_ = std::max(largest_, std::abs(entry.second));
    }
  }
}

void SquareMatrix::check() const {
  for (std::size_t row = 0; row < diagonal_.size(); ++row) {
    if (diagonal_[row] < 0) {
      fail(static_cast<PetscInt>(row), static_cast<PetscInt>(row),
           sentence("{} on the diagonal; a structure that resists has none below zero",
                    {diagonal_[row]}));
    }
  }
  for (std::size_t row = 0; row < owned_dof_.size(); ++row) {
    if (owned_dof_[row] >= 0) {
      const std::size_t dof = owned_dof_[row];
      check_row(static_cast<PetscInt>(row), rows_[dof], mirrored_[dof]);
    }
  }
}

void SquareMatrix::check_row(PetscInt row, const std::vector<Entry>& entries,
                             const std::vector<Entry>& mirrored) const {
  auto other = mirrored.begin();
  for (auto here = entries.begin(); here != entries.end() || other != mirrored.end();) {
    const bool from_here =
        other == mirrored.end() || (here != entries.end() && here->first <= other->first);
    const PetscInt column = from_here ? here->first : other->first;
    const double value = from_here ? (here++)->second : 0;
    const bool has_mirror = other != mirrored.end() && other->first == column;
    const double opposite = has_mirror ? (other++)->second : 0;
    if (std::abs(value - opposite) > round_off * largest_) {
      fail(row, column,
           sentence("{}, but {} at row {}, column {}: not symmetric",
                    {value, opposite, column + 1, row + 1}));
    }
    const double bound = std::sqrt(diagonal_[row] * diagonal_[column]);
    if (std::abs(value) > bound + round_off * largest_) {
      fail(row, column,
           sentence("{}, more than the diagonals there allow ({}): some motion would give energy",
                    {value, bound}));
    }
  }
}

void SquareMatrix::fail(PetscInt row, PetscInt column, const std::string& what) const {
  throw UserError(sentence("{}: row {}, column {}: {}", {path_, row + 1, column + 1, what}));
}

}  // namespace pounding
