#include "interactions/frictional_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/array_reductions.h"

namespace pounding::interactions {

std::vector<Constraint> with_friction_rows(std::span<const Constraint> constraints) {
  std::vector<Constraint> rows(constraints.begin(), constraints.end());
  for (Constraint& row : tangential_rows(constraints)) {
    if (row.friction > 0) rows.push_back(std::move(row));
  }
  return rows;
}

FrictionalContact::FrictionalContact(const ContactOperator& contact,
                                     const InterfaceCompliance& compliance,
                                     std::span<const Constraint> constraints)
    : operator_(contact),
      compliance_(compliance),
      index_(contact.rows(), -1),
      impulse_(constraints.size()),
      previous_(constraints.size()),
      across_(constraints.size()),
      slip_(constraints.size(), 0.0),
      loss_(constraints.size(), 0.0) {
  int tangent = static_cast<int>(constraints.size());
  for (const Constraint& constraint : constraints) {
    const bool slides = constraint.friction > 0;
    points_.push_back(
        {slides ? tangent : -1, constraint.friction, tangents_of(normal_of(constraint))});
    if (slides) tangent += 2;
    has_any_ = has_any_ || slides;
  }
}

int FrictionalContact::operator_row(int row, std::size_t direction) const {
  if (direction == 0) return row;
  const int tangent = points_[row].tangent;
  return tangent < 0 ? -1 : tangent + static_cast<int>(direction) - 1;
}

std::size_t FrictionalContact::add(std::vector<int> rows, DelassusPattern& pattern) {
  Component& component = components_.emplace_back();
  component.rows = std::move(rows);
  for (std::size_t i = 0; i < component.rows.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) {
      const int at = operator_row(component.rows[i], d);
      if (at >= 0) index_[at] = static_cast<int>(i);
    }
  }
  for (const int row : component.rows) {
    std::vector<int> own;
    for (std::size_t d = 0; d < 3; ++d) {
      if (operator_row(row, d) >= 0) own.push_back(operator_row(row, d));
    }
    std::vector<int> neighbours;
    for (const int coupled : pattern.coupled_with(own)) neighbours.push_back(index_[coupled]);
    std::ranges::sort(neighbours);
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    for (std::size_t d = 0; d < 3; ++d) {
      for (const int neighbour : neighbours) {
        for (std::size_t e = 0; e < 3; ++e) {
          const int i = operator_row(row, d);
          const int j = operator_row(component.rows[neighbour], e);
          component.delassus.add(3 * neighbour + static_cast<int>(e),
                                 i < 0 || j < 0 ? 0 : delassus_entry(operator_, compliance_, i, j));
        }
      }
      component.delassus.end_row();
    }
  }
  return components_.size() - 1;
}

void FrictionalContact::reserve() {
  std::size_t largest = 0;
  std::size_t most_entries = 0;
  for (const Component& component : components_) {
    largest = std::max(largest, component.rows.size());
    most_entries = std::max(most_entries, component.delassus.entries());
  }
  if (largest == 0) return;
  solver_.emplace(largest);
  indices_.reserve(largest);
  numbers_.reserve(3 * largest);
  matrix_.reserve(3 * largest, most_entries);
  rate_.resize(3 * largest);
  solution_.resize(3 * largest);
  coefficient_.resize(largest);
}

void FrictionalContact::clear() {
  if (!has_any_) return;
  previous_ = impulse_;
  std::ranges::fill(impulse_, std::array<double, 3>{});
  std::ranges::fill(across_, Vector3{});
  std::ranges::fill(slip_, 0.0);
  std::ranges::fill(loss_, 0.0);
}

FrictionalContact::Solution FrictionalContact::solve(
    std::size_t number, std::span<const char> active, std::span<const double> before,
    std::span<const double> free, std::span<double> impulse, std::span<double> work,
    std::span<double> dof_impulse) {
  const Component& component = components_[number];
  indices_.clear();
  for (std::size_t i = 0; i < component.rows.size(); ++i) {
    if (active[component.rows[i]] != 0) indices_.push_back(i);
  }
  if (indices_.empty()) return {};
  const std::size_t n = 3 * indices_.size();
  numbers_.assign(3 * component.rows.size(), -1);
  for (std::size_t i = 0; i < n; ++i) {
    numbers_[3 * indices_[i / 3] + i % 3] = static_cast<int>(i);
    const int row = component.rows[indices_[i / 3]];
    const int at = operator_row(row, i % 3);
    rate_[i] = at < 0 ? 0 : operator_.apply(at, free);
    solution_[i] = previous_[row][i % 3];
    coefficient_[i / 3] = points_[row].coefficient;
  }
  take_principal_part(component.delassus, numbers_, matrix_);
  const FrictionProblem problem{matrix_, {rate_.data(), n}, coefficient_};
  const FrictionResult result = solver_->solve(problem, {solution_.data(), n});
  for (std::size_t i = 0; i < n; i += 3) {
    const int row = component.rows[indices_[i / 3]];
    std::array<double, 3> after{};
    double twice = 0;  // work of friction
    for (std::size_t d = 0; d < 3; ++d) {
      const int at = operator_row(row, d);
      if (at < 0) continue;
      after[d] = rate_[i + d];
      for (std::size_t k = matrix_.begin[i + d]; k < matrix_.begin[i + d + 1]; ++k) {
        after[d] += matrix_.value[k] * solution_[matrix_.column[k]];
      }
      const double lambda = solution_[i + d];
      operator_.add_transposed(at, lambda, dof_impulse);
      const double both = lambda * (operator_.apply(at, before) + after[d]);
      if (d == 0) {
        work[row] = both / 2;
      } else {
        twice += both;
      }
      impulse_[row][d] = lambda;
    }
    impulse[row] = solution_[i];
    for (std::size_t d = 0; d < 3; ++d) {
      const auto& [first, second] = points_[row].tangents;
      across_[row][d] = solution_[i + 1] * first[d] + solution_[i + 2] * second[d];
    }
    slip_[row] = std::hypot(after[1], after[2]);
    loss_[row] = -twice / 2;
  }
  return {result.residual, largest_magnitude({rate_.data(), n})};
}

void FrictionalContact::keep(const StateKeeper& state) {
  if (!has_any_) return;
  state.rows("contact_friction", impulse_.size(), [&](std::size_t row, const auto& take) {
    take(impulse_[row][0], impulse_[row][1], impulse_[row][2]);
  });
}

}  // namespace pounding::interactions
