#include "contact/contact_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/contact_components.h"

namespace pounding {
namespace {

/// Round-off of H lambda, relative to the free gap rates, above which the impulse is corrected.
constexpr double correction_threshold = 1e-12;

}  // namespace

ContactProblem::ContactProblem(MPI_Comm comm, const Interface& interface,
                               std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                               double gap_tolerance)
    : operator_(comm, interface.constraints, meshes),
      gather_(comm, operator_, meshes),
      gap_tolerance_(gap_tolerance) {
  const auto dofs = static_cast<std::size_t>(operator_.dofs());
  const auto rows = static_cast<std::size_t>(operator_.rows());
  inverse_mass_.assign(dofs, 0.0);
  for (const InterfaceGather::Owned& owned : gather_.owned()) {
    inverse_mass_[static_cast<std::size_t>(owned.interface_dof)] =
        systems[static_cast<std::size_t>(owned.structure)]
            .inverse_mass[static_cast<std::size_t>(owned.dof)];
  }
  MPI_Allreduce(MPI_IN_PLACE, inverse_mass_.data(), static_cast<int>(dofs), MPI_DOUBLE, MPI_SUM,
                comm);
  for (const Constraint& constraint : interface.constraints) {
    initial_gap_.push_back(constraint.initial_gap);
  }
  mine_.assign(InterfaceGather::max_fields * gather_.owned().size(), 0.0);
  all_.assign(InterfaceGather::max_fields * dofs, 0.0);
  gap_ = initial_gap_;
  impulse_.assign(rows, 0.0);
  previous_.assign(rows, 0.0);
  work_.assign(rows, 0.0);
  active_.assign(rows, 0);
  dof_impulse_.assign(dofs, 0.0);
  dof_increment_.assign(dofs, 0.0);
  smallest_gap_ = rows > 0 ? *std::min_element(gap_.begin(), gap_.end()) : 0;
  build_delassus(systems);
  find_components();
}

void ContactProblem::build_delassus(std::span<const LinearSystem> systems) {
  rate_norm_.assign(systems.size(), 0.0);
  for (int row = 0; row < operator_.rows(); ++row) {
    diagonal_.push_back(delassus_entry(row, row));
    std::vector<double> norm(systems.size(), 0.0);
    const auto columns = operator_.row_dofs(row);
    const auto values = operator_.row_coefficients(row);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto dof = static_cast<std::size_t>(columns[k]);
      norm[static_cast<std::size_t>(operator_.dof_list()[dof].structure)] +=
          values[k] * values[k] * inverse_mass_[dof];
    }
    for (std::size_t s = 0; s < norm.size(); ++s) {
      rate_norm_[s] = std::max(rate_norm_[s], std::sqrt(norm[s]));
    }
  }
}

double ContactProblem::delassus_entry(int row, int column) const {
  double sum = 0;
  const auto row_dofs = operator_.row_dofs(row);
  const auto row_values = operator_.row_coefficients(row);
  const auto column_dofs = operator_.row_dofs(column);
  const auto column_values = operator_.row_coefficients(column);
  for (std::size_t a = 0; a < row_dofs.size(); ++a) {
    for (std::size_t b = 0; b < column_dofs.size(); ++b) {
      if (row_dofs[a] == column_dofs[b]) {
        sum +=
            row_values[a] * inverse_mass_[static_cast<std::size_t>(row_dofs[a])] * column_values[b];
      }
    }
  }
  return sum;
}

void ContactProblem::find_components() {
  std::vector<std::vector<int>> row_dofs;
  for (int row = 0; row < operator_.rows(); ++row) {
    const auto dofs = operator_.row_dofs(row);
    row_dofs.emplace_back(dofs.begin(), dofs.end());
  }
  components_ = coupled_components(row_dofs, operator_.dofs());
  std::size_t largest = 1;
  for (const std::vector<int>& component : components_) {
    largest = std::max(largest, component.size());
    coupled_rows_ += component.size() > 1 ? static_cast<int>(component.size()) : 0;
  }
  active_rows_.reserve(largest);
  matrix_.resize(largest * largest);
  rate_.resize(largest);
  solution_.resize(largest);
  increment_.resize(largest);
  if (largest > 1) {
    lcp_ = std::make_unique<LcpSolver>(static_cast<int>(largest));
  }
}

void ContactProblem::gather() {
  gather_.gather(3, mine_, all_);
  const std::span<const double> u(all_.data(), inverse_mass_.size());
  smallest_gap_ = std::numeric_limits<double>::max();
  for (int row = 0; row < operator_.rows(); ++row) {
    const auto r = static_cast<std::size_t>(row);
    gap_[r] = initial_gap_[r] + operator_.apply(row, u);
    smallest_gap_ = std::min(smallest_gap_, gap_[r]);
  }
}

bool ContactProblem::detect_contact() {
  bool any = false;
  for (std::size_t r = 0; r < gap_.size(); ++r) {
    // A row without mass on either side has nothing to move.
    active_[r] = gap_[r] <= gap_tolerance_ && diagonal_[r] > 0 ? 1 : 0;
    any = any || active_[r] != 0;
  }
  return any;
}

void ContactProblem::solve_component(const std::vector<int>& component) {
  const std::size_t dofs = inverse_mass_.size();
  const std::span<const double> free_velocity(all_.data() + 2 * dofs, dofs);
  active_rows_.clear();
  for (const int row : component) {
    if (active_[static_cast<std::size_t>(row)] != 0) {
      active_rows_.push_back(row);
    }
  }
  const std::size_t n = active_rows_.size();
  if (n == 1) {
    const auto r = static_cast<std::size_t>(active_rows_[0]);
    impulse_[r] = std::max(0.0, -operator_.apply(active_rows_[0], free_velocity)) / diagonal_[r];
    operator_.add_transposed(active_rows_[0], impulse_[r], dof_impulse_);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    rate_[i] = operator_.apply(active_rows_[i], free_velocity);
    solution_[i] = previous_[static_cast<std::size_t>(active_rows_[i])];
    for (std::size_t j = 0; j < n; ++j) {
      matrix_[i * n + j] = delassus_entry(active_rows_[i], active_rows_[j]);
    }
  }
  if (n == 0) {
    return;
  }
  const LcpResult result =
      lcp_->solve({matrix_.data(), n * n}, {rate_.data(), n}, {solution_.data(), n});
  largest_residual_ = std::max(largest_residual_, result.residual);
  for (std::size_t i = 0; i < n; ++i) {
    operator_.add_transposed(active_rows_[i], solution_[i], dof_impulse_);
  }
  if (result.roundoff > correction_threshold) {
    correct_component();
  }
  for (std::size_t i = 0; i < n; ++i) {
    impulse_[static_cast<std::size_t>(active_rows_[i])] = solution_[i];
  }
}

void ContactProblem::correct_component() {
  const std::size_t dofs = inverse_mass_.size();
  const std::size_t n = active_rows_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto columns = operator_.row_dofs(active_rows_[i]);
    const auto values = operator_.row_coefficients(active_rows_[i]);
    rate_[i] = 0;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto dof = static_cast<std::size_t>(columns[k]);
      rate_[i] += values[k] * (all_[2 * dofs + dof] + inverse_mass_[dof] * dof_impulse_[dof]);
    }
  }
  lcp_->correct({rate_.data(), n}, {solution_.data(), n}, {increment_.data(), n});
  for (std::size_t i = 0; i < n; ++i) {
    operator_.add_transposed(active_rows_[i], increment_[i], dof_increment_);
  }
}

void ContactProblem::solve_impulse() {
  previous_ = impulse_;
  std::fill(impulse_.begin(), impulse_.end(), 0.0);
  std::fill(work_.begin(), work_.end(), 0.0);
  std::fill(dof_impulse_.begin(), dof_impulse_.end(), 0.0);
  std::fill(dof_increment_.begin(), dof_increment_.end(), 0.0);
  for (const std::vector<int>& component : components_) {
    solve_component(component);
  }
  const std::size_t dofs = inverse_mass_.size();
  const std::span<const double> velocity_before(all_.data() + dofs, dofs);
  for (int row = 0; row < operator_.rows(); ++row) {
    const double impulse = impulse_[static_cast<std::size_t>(row)];
    if (impulse > 0) {
      work_[static_cast<std::size_t>(row)] = 0.5 * impulse * operator_.apply(row, velocity_before);
    }
  }
}

double ContactProblem::corrected_velocity(std::size_t i, double free_velocity) const {
  const auto dof = static_cast<std::size_t>(gather_.owned()[i].interface_dof);
  const double velocity = free_velocity + inverse_mass_[dof] * dof_impulse_[dof];
  return velocity + inverse_mass_[dof] * dof_increment_[dof];
}

void ContactProblem::save(SavedState& saved) const {
  saved.put("contact_impulse", impulse_);
  saved.put("contact_largest_residual", {largest_residual_});
}

void ContactProblem::load(const SavedState& saved) {
  saved.get("contact_impulse", impulse_);
  largest_residual_ = saved.number("contact_largest_residual");
}

double ContactProblem::total_work() const {
  double sum = 0;
  for (const double work : work_) {
    sum += work;
  }
  return sum;
}

}  // namespace pounding
