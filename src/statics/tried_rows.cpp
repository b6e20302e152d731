#include "statics/tried_rows.h"

#include <algorithm>
#include <cmath>

#include "solvers/lcp.h"

namespace pounding {
namespace {

/// Negative opening of a row that counts as violated, relative to the largest opening.
constexpr double violation = 1e-13;

}  // namespace

Fields zeros(std::span<const LinearSystem> systems) {
  Fields fields;
  for (const LinearSystem& system : systems) fields.emplace_back(system.lumped_mass.size(), 0.0);
  return fields;
}

Fields TriedRows::on_dofs(int first, int end) const {
  Fields forces = zeros(systems_);
  for (int i = first; i < end; ++i) {
    if (force_[i] != 0) rows_.add_force(i, force_[i], forces);
  }
  return forces;
}

std::vector<double> TriedRows::solve(std::vector<double> opening) {
  const std::vector<double> before = force_;
  double scale = 0;
  for (int i = 0; i < rows_.size(); ++i) {
    opening[i] += rows_.compliance(i) * force_[i];
    if (rows_.open(i)) continue;
    scale = std::max(scale, std::abs(opening[i]));
  }
  std::vector<double> change(rows_.size(), 0.0);
  do {
    if (!tried_.empty()) solve_tried(opening, before);
    for (int i = 0; i < rows_.size(); ++i) change[i] = force_[i] - before[i];
  } while (try_violated(opening, change, -violation * scale));
  return change;
}

bool TriedRows::try_violated(std::vector<double> opening, const std::vector<double>& change,
                             double limit) {
  for (std::size_t j = 0; j < tried_.size(); ++j) {
    for (int i = 0; i < rows_.size(); ++i) opening[i] += response_[j][i] * change[tried_[j]];
  }
  bool any = false;
  for (int i = 0; i < rows_.size(); ++i) {
    if (!is_tried_[i] && !rows_.open(i) && opening[i] < limit) {
      try_row(i);
      any = true;
    }
  }
  return any;
}

void TriedRows::try_row(int row) {
  Fields field = zeros(systems_);
  rows_.add_force(row, 1, field);
  for (std::size_t s = 0; s < field.size(); ++s) stiffness_[s]->solve(field[s]);
  is_tried_[row] = true;
  tried_.push_back(row);
  response_.push_back(rows_.responses(field));
  response_.back()[row] += rows_.compliance(row);
}

void TriedRows::solve_tried(const std::vector<double>& opening, const std::vector<double>& before) {
  const std::size_t n = tried_.size();
  std::vector<double> matrix(n * n);
  std::vector<double> free(n);
  std::vector<double> force(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      matrix[i * n + j] = (response_[j][tried_[i]] + response_[i][tried_[j]]) / 2;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    free[i] = opening[tried_[i]];
    for (std::size_t j = 0; j < n; ++j) free[i] -= matrix[i * n + j] * before[tried_[j]];
    force[i] = force_[tried_[i]];
  }
  interactions::LcpSolver(static_cast<int>(n)).solve(matrix, free, force);
  for (std::size_t i = 0; i < n; ++i) force_[tried_[i]] = force[i];
}

}  // namespace pounding
