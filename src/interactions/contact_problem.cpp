#include "interactions/contact_problem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/array_reductions.h"
#include "common/parallel.h"
#include "interactions/delassus.h"

namespace pounding::interactions {
namespace {

/// Round-off of H lambda, relative to the free gap rates, above which the impulse is corrected.
constexpr double correction_threshold = 1e-12;

/// Gap rates that are round-off, relative to the largest free one so far.
constexpr double rate_roundoff = 1e-14;

void add(std::span<const double> values, std::span<double> sum) {
  for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
}

}  // namespace

ContactProblem::ContactProblem(MPI_Comm comm, const Interface& interface,
                               std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                               double gap_tolerance)
    : constraints_(interface.constraints),
      interface_(comm, with_friction_rows(constraints_), systems, meshes,
                 SlidingPairs::all_terms(interface.sliding)),
      sliding_(interface_.rows(), interface),
      friction_(interface_.rows(), interface_.compliance(), interface.constraints),
      gap_tolerance_(gap_tolerance) {
  const std::size_t dofs = interface_.dofs();
  const std::size_t rows = interface.constraints.size();
  for (const Constraint& constraint : interface.constraints) {
    initial_gap_.push_back(constraint.initial_gap);
    crushes_ = crushes_ || constraint.filler.depth > 0;
    face_gap_.push_back(constraint.of_faces(constraint.initial_gap));
  }
  for (auto* const room : {&displacement_, &dof_impulse_, &dof_increment_}) room->assign(dofs, 0.0);
  for (auto* const room : {&impulse_, &previous_, &work_}) room->assign(rows, 0.0);
  velocities_.assign(InterfaceGather::max_fields * dofs, 0.0);
  gap_ = initial_gap_;
  active_.assign(rows, 0);
  smallest_gap_ = rows > 0 ? *std::min_element(gap_.begin(), gap_.end()) : 0;
  build_delassus();
}

void ContactProblem::build_delassus() {
  diagonal_.clear();
  may_act_.clear();
  for (int row = 0; row < rows(); ++row) {
    diagonal_.push_back(delassus_entry(interface_.rows(), interface_.compliance(), row, row));
    // A row without mass on either side has nothing to move, and a spring gives way.
    may_act_.push_back(diagonal_.back() > 0 && !constraints_[row].filler.is_spring() ? 1 : 0);
  }
  find_components();
}

void ContactProblem::take_new_pairs() {
  for (std::size_t row = 0; row < constraints_.size(); ++row) {
    initial_gap_[row] = constraints_[row].initial_gap;
  }
  interface_.rows().set_rows(with_friction_rows(constraints_));
  build_delassus();
}

std::vector<double> ContactProblem::row_force(int row, std::size_t structure,
                                              LocalIndex owned_dofs) const {
  std::vector<double> force(owned_dofs, 0.0);
  interface_.add_force(row, 1, structure, force);
  return force;
}

double ContactProblem::row_compliance(int row, std::size_t structure) const {
  const auto dofs = interface_.rows().row_dofs(row);
  const auto values = interface_.rows().row_coefficients(row);
  double sum = 0;
  for (std::size_t a = 0; a < dofs.size(); ++a) {
    const std::size_t dof = dofs[a];
    for (std::size_t b = 0; interface_.structure_of(dof) == structure && b < dofs.size(); ++b) {
      sum += values[a] * values[b] *
             interface_.compliance().entry(dof, static_cast<std::size_t>(dofs[b]));
    }
  }
  return std::max(sum, 0.0);
}

void ContactProblem::gather_displacements() {
  interface_.gather(1, displacement_);
  if (carried_ != nullptr) add(carried_->displacement, displacement_);
  if (sliding_.any() && sliding_.find(displacement_, constraints_)) take_new_pairs();
  smallest_gap_ = std::numeric_limits<double>::max();
  for (const int row : held_) {
    const std::size_t r = row;
    gap_[r] = initial_gap_[r] + interface_.rows().apply(row, displacement_);
    smallest_gap_ = std::min(smallest_gap_, gap_[r]);
    if (crushes_) face_gap_[r] = constraints_[r].of_faces(gap_[r]);
  }
}

bool ContactProblem::detect_contact() {
  bool any = false;
  for (const int row : held_) {
    active_[row] = gap_[row] <= gap_tolerance_ ? may_act_[row] : 0;
    any = any || active_[row] != 0;
  }
  for (Component& component : components_) {
    if (!component.share) continue;
    const auto acts = [this](int row) { return active_[row] != 0; };
    std::array<double, 1> least{std::ranges::any_of(component.rows, acts) ? -1.0 : 0.0};
    component.share->agree({}, least);
    component.acts = least[0] < 0;
    any = any || component.acts;
  }
  return any;
}

void ContactProblem::gather_velocities() {
  interface_.gather(2, velocities_);
  if (carried_ == nullptr) return;
  const std::size_t dofs = displacement_.size();
  add(carried_->velocity_before, {velocities_.data(), dofs});
  add(carried_->velocity, {velocities_.data() + dofs, dofs});
}

void ContactProblem::solve_with_friction(const Component& component) {
  const FrictionalContact::Solution solution =
      friction_.solve(static_cast<std::size_t>(component.frictional), active_, velocity(0),
                      velocity(1), impulse_, work_, dof_impulse_);
  note_residual(solution.residual, solution.free_rate);
}

void ContactProblem::solve_lone_rows() {
  for (const int row : lone_) {
    if (active_[row] == 0) continue;
    const double closing = -interface_.rows().apply(row, velocity(1));
    if (!(closing > 0)) continue;
    impulse_[row] = closing / diagonal_[row];
    work_[row] = 0.5 * impulse_[row] * interface_.rows().apply(row, velocity(0));
    interface_.rows().add_transposed(row, impulse_[row], dof_impulse_);
  }
}

void ContactProblem::solve_component(Component& component) {
  if (component.frictional >= 0) {
    solve_with_friction(component);
    return;
  }
  active_indices_.clear();
  for (std::size_t i = 0; i < component.rows.size(); ++i) {
    if (active_[component.rows[i]] != 0) active_indices_.push_back(i);
  }
  if (component.share) {
    if (component.acts) solve_coupled(component);
  } else if (active_indices_.size() == 1) {
    const int row = component.rows[active_indices_[0]];
    impulse_[row] = std::max(0.0, -interface_.rows().apply(row, velocity(1))) / diagonal_[row];
    interface_.rows().add_transposed(row, impulse_[row], dof_impulse_);
  } else if (!active_indices_.empty()) {
    solve_coupled(component);
  }
}

void ContactProblem::solve_coupled(Component& component) {
  const std::size_t n = active_indices_.size();
  const auto row = [&](std::size_t i) { return component.rows[active_indices_[i]]; };
  for (std::size_t i = 0; i < n; ++i) {
    rate_[i] = interface_.rows().apply(row(i), velocity(1));
    solution_[i] = previous_[row(i)];
  }
  const LcpResult result = lcp_->solve(component.delassus, component.many.get(), active_indices_,
                                       {rate_.data(), n}, {solution_.data(), n});
  note_residual(result.residual, result.free_rate);
  add_impulses(component, solution_, dof_impulse_);
  if (result.roundoff > correction_threshold) correct_component(component);
  for (std::size_t i = 0; i < n; ++i) impulse_[row(i)] = solution_[i];
}

void ContactProblem::add_impulses(Component& component, std::span<const double> impulses,
                                  std::span<double> sum) {
  for (std::size_t i = 0; i < active_indices_.size(); ++i) {
    interface_.rows().add_transposed(component.rows[active_indices_[i]], impulses[i], sum);
  }
  if (!component.share) return;
  std::vector<double>& values = component.numbered;
  std::ranges::fill(values, 0.0);
  for (std::size_t i = 0; i < active_indices_.size(); ++i) {
    values[component.share->first() + active_indices_[i]] = impulses[i];
  }
  component.share->bring_felt(values);
  for (const SharedRows::Felt& other : component.share->felt()) {
    if (values[other.number] == 0) continue;
    interface_.rows().add_transposed(other.row, values[other.number], sum);
  }
}

void ContactProblem::note_residual(double residual, double rate) {
  largest_rate_ = std::max(largest_rate_, rate);
  // Where all is at rest, rates are round-off of larger ones, which fits no rigid body.
  const double left = residual * rate;
  const bool is_roundoff = left <= rate_roundoff * largest_rate_;
  const double noted = is_roundoff && largest_rate_ > 0 ? left / largest_rate_ : residual;
  largest_residual_ = std::max(largest_residual_, noted);
}

void ContactProblem::correct_component(Component& component) {
  const std::size_t dofs = displacement_.size();
  const std::size_t n = active_indices_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const int row = component.rows[active_indices_[i]];
    const auto columns = interface_.rows().row_dofs(row);
    const auto values = interface_.rows().row_coefficients(row);
    rate_[i] = 0;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::size_t dof = columns[k];
      rate_[i] += values[k] * (velocities_[dofs + dof] +
                               interface_.compliance().velocity_change(dof, dof_impulse_));
    }
  }
  lcp_->correct({rate_.data(), n}, {solution_.data(), n}, {increment_.data(), n});
  incremented_ = true;
  add_impulses(component, increment_, dof_increment_);
}

void ContactProblem::clear_impulse() {
  if (!components_.empty()) previous_ = impulse_;
  std::fill(impulse_.begin(), impulse_.end(), 0.0);
  std::fill(work_.begin(), work_.end(), 0.0);
  friction_.clear();
}

void ContactProblem::solve_impulse() {
  clear_impulse();
  std::fill(dof_impulse_.begin(), dof_impulse_.end(), 0.0);
  if (incremented_) std::fill(dof_increment_.begin(), dof_increment_.end(), 0.0);
  incremented_ = false;
  solve_lone_rows();
  for (Component& component : components_) solve_component(component);
  for (const Component& component : components_) {
    for (const int row : component.rows) {
      if (impulse_[row] > 0 && component.frictional < 0) {
        work_[row] = 0.5 * impulse_[row] * interface_.rows().apply(row, velocity(0));
      }
    }
  }
}

void ContactProblem::add_velocity_change(std::size_t structure, double* velocity) {
  interface_.add_velocity_change(structure, dof_impulse_, velocity);
  if (incremented_) interface_.add_velocity_change(structure, dof_increment_, velocity);
}

void ContactProblem::add_dof_impulses(std::span<double> sum) const {
  for (std::size_t dof = 0; dof < sum.size(); ++dof) {
    sum[dof] += dof_impulse_[dof] + dof_increment_[dof];
  }
}

double ContactProblem::support_work(std::size_t structure, std::span<const double> velocity) {
  double work = 0;
  for (const std::vector<double>* impulse : {&dof_impulse_, &dof_increment_}) {
    work += interface_.support_work(structure, *impulse, velocity);
  }
  return work;
}

double ContactProblem::sum_of_counted(std::span<const double> values) const {
  double sum = 0;
  for (const int row : counted_) sum += values[row];
  return sum;
}

void ContactProblem::keep(const StateKeeper& state) {
  if (state.puts() && members() > 1) {
    share_rows(comm(), counted_, 1, impulse_);
    share_rows(comm(), counted_, 3, friction_.kept());
    reduce_over_ranks(comm(), MPI_MAX, largest_residual_, largest_rate_);
    if (rank_of(comm()) != 0) return;
  }
  state.table("contact_impulse", impulse_);
  state.numbers("contact_largest_residual", largest_residual_, largest_rate_);
  friction_.keep(state);
  sliding_.keep(state, constraints_);
  if (sliding_.any() && !state.puts()) take_new_pairs();
}

}  // namespace pounding::interactions
