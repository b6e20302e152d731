#include "dynamics/unilateral_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/parallel.h"
#include "common/row_products.h"
#include "dynamics/state.h"
#include "dynamics/structure_step.h"

namespace pounding {
namespace {

/// More than rounding can take from a sum of all coordinates.
constexpr double above_round_off = 1 + 1e-9;

}  // namespace

UnilateralContact::UnilateralContact(MPI_Comm comm, interactions::ContactProblem& problem,
                                     GapWatch watch, const State& state)
    : problem_(problem),
      watch_(std::move(watch)),
      state_(state),
      is_root_(problem.root() == rank_of(comm)) {
  for (std::size_t s = 0; s < state.structures.size(); ++s) {
    const std::size_t dofs = problem_.trace(s).dofs().size();
    before_.emplace_back(dofs);
    velocity_.emplace_back(dofs, 0.0);
  }
}

UnilateralContact::~UnilateralContact() = default;

void UnilateralContact::attach(std::span<interactions::SteppedStructure* const> structures) {
  for (std::size_t s = 0; s < structures.size(); ++s) {
    structures[s]->watch(problem_.trace(s).dofs(), false);
  }
}

void UnilateralContact::begin(const interactions::Step& step) {
  interface_known_ = problem_.member() && (step.look_at_gap || watch_.due(step.number));
  touching_ = false;
  may_touch_ = false;
  if (interface_known_) detect_contact(step);
}

void UnilateralContact::push(const interactions::Step& step) {
  if (!takes_part()) return;
  solve_impulse(step);  // 0 <= lambda _|_ H lambda + L v_free >= 0   on A
  if (!touching_) return;
  correct_velocity(step);  // v+ = v_free + M^-1 L^T lambda,   u_{n+1} = u_n + dt v+
}

void UnilateralContact::detect_contact(const interactions::Step& step) {
  const ScopedEvent event(events_.detect_contact);
  const ScopedTimer timer(step.profile, Phase::contact);
  ++looks_;
  for (std::size_t s = 0; s < before_.size(); ++s) {
    std::span<const double> points;
    if (step.look_at_gap) points = step.structures[s]->points(problem_.trace(s));
    step.structures[s]->bring(problem_.trace(s).dofs());
    if (points.empty()) {
      problem_.set_displacement(s, step.structures[s]->displacement().data(),
                                step.supports.displacement);
    } else {
      problem_.set_point_displacement(s, points, step.supports.displacement);
    }
  }
  problem_.gather_displacements();
  touching_ = problem_.detect_contact();
  const auto [gap, touched] = agree(step.number);
  for (std::size_t s = 0; takes_part() && s < before_.size(); ++s) {
    problem_.set_velocity_before(s, step.structures[s]->velocity().data(),
                                 step.supports.velocity_before);
    step.structures[s]->remember(problem_.trace(s).dofs(), before_[s]);
  }
  if (!touching_) {
    problem_.clear_impulse();
    if (!may_touch_ && !watch_.needs_look(step.number)) return;
    if (!may_touch_ && watch_.measures()) measure(step);
  }
  watch_.looked(step.number, gap - problem_.gap_tolerance(), touched);
}

std::pair<double, bool> UnilateralContact::agree(std::int64_t step) {
  std::array<double, 2> found{problem_.smallest_gap(), touching_ ? -1.0 : 0.0};
  const bool alone = problem_.alike();
  const bool waits = watch_.can_wait(step);
  if (waits && !alone) problem_.reduce(MPI_MIN, found);
  may_touch_ = found[1] < 0 || !(waits || alone);
  return {found[0], found[1] < 0};
}

void UnilateralContact::agree_on_last_touch() {
  if (!problem_.member() || problem_.alike()) return;
  std::array<double, 1> earliest{-static_cast<double>(watch_.last_touch())};
  problem_.reduce(MPI_MIN, earliest);
  watch_.set_last_touch(static_cast<std::int64_t>(-earliest[0]));
}

void UnilateralContact::energies_known(std::int64_t step, std::span<const StructureEnergy> energies,
                                       std::span<const double> round_off) {
  agree_on_last_touch();
  watch_.energies_known(step, energies, round_off);
}

void UnilateralContact::measure(const interactions::Step& step) {
  for (const interactions::SteppedStructure* structure : step.structures) structure->bring_state();
  problem_.reduce(MPI_SUM, watch_.measure(state_.structures));
}

void UnilateralContact::solve_impulse(const interactions::Step& step) {
  const ScopedEvent event(events_.solve_impulse);
  const ScopedTimer timer(step.profile, Phase::contact);
  for (std::size_t s = 0; s < before_.size(); ++s) {
    problem_.set_free_velocity(s, step.structures[s]->velocity().data(), step.supports.velocity);
  }
  problem_.gather_velocities();
  if (touching_) problem_.solve_impulse();
}

void UnilateralContact::correct_velocity(const interactions::Step& step) {
  const ScopedEvent event(events_.correct_velocity);
  const ScopedTimer timer(step.profile, Phase::contact);
  for (std::size_t s = 0; s < before_.size(); ++s) {
    const Trace& trace = problem_.trace(s);
    trace.restrict_to_dofs(step.structures[s]->velocity().data(), velocity_[s].data());
    problem_.add_velocity_change(s, velocity_[s].data());
    step.structures[s]->correct(trace.dofs(), before_[s], velocity_[s]);
  }
}

void UnilateralContact::finish(const interactions::Step& step) {
  if (!touching_) return;
  const std::vector<double>& supports = step.supports.velocity_mean;
  for (std::size_t s = 0; !supports.empty() && s < before_.size(); ++s) {
    step.ledger[s]->contact_support_input = -problem_.support_work(s, supports);
  }
  step.ledger.front()->contact_work = problem_.total_work();
  step.ledger.front()->friction_loss = problem_.total_friction_loss();
}

void UnilateralContact::keep(const StateKeeper& state) {
  if (state.puts() && !problem_.member()) return;
  if (state.puts()) agree_on_last_touch();
  if (is_root_ || !state.puts()) watch_.keep(state);
  problem_.keep(state);
}

GapWatch::GapWatch(std::span<const LinearSystem> systems, std::vector<Bound> bounds,
                   const Vector3& peaks, double time_step)
    : time_step_(time_step),
      coordinates_(systems.size()),
      measured_(2 * systems.size(), 0.0),
      root_energy_(systems.size(), 0.0) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    const Vector3& g = systems[s].gravity;
    rate_norm_.push_back(bounds[s].rate_norm);
    double growth = time_step * bounds[s].rest_norm.value_or(0);
    for (std::size_t d = 0; d < 3; ++d) {
      const double weight = bounds[s].rest_norm ? 0 : std::abs(g[d]);
      growth += time_step * (peaks[d] + weight) * bounds[s].force_norm[d];
    }
    growth_.push_back(growth);
    possible_ = possible_ && std::isfinite(bounds[s].rate_norm);
    if (goes_by_coordinates(systems[s])) {
      coordinates_[s] =
          std::make_unique<CoordinateRates>(systems[s], std::move(bounds[s].coordinate_rows),
                                            std::hypot(peaks[0], peaks[1], peaks[2]), time_step);
      measures_ = true;
    } else {
      needs_energy_ = true;
    }
  }
}

void GapWatch::keep(const StateKeeper& state) {
  state.table("gap_watch_root_energy", root_energy_);
  state.numbers("gap_watch_steps", energy_step_, last_touch_, next_look_);
}

void GapWatch::energies_known(std::int64_t step, std::span<const StructureEnergy> energies,
                              std::span<const double> round_off) {
  energy_step_ = step;
  for (std::size_t s = 0; s < energies.size(); ++s) {
    // Round-off of a structure at rest, or far from its place, must not count as knowledge that
    // nothing moves.
    root_energy_[s] = std::sqrt(2 * (std::max(0.0, energies[s].held) + round_off[s])) * (1 + 1e-6);
  }
}

std::span<double> GapWatch::measure(std::span<const StructureState> structures) {
  for (std::size_t s = 0; s < structures.size(); ++s) {
    if (coordinates_[s]) {
      measured_[2 * s] = coordinates_[s]->rate(structures[s]);
      measured_[2 * s + 1] = coordinates_[s]->growth();
    }
  }
  return measured_;
}

double GapWatch::rate_bound(std::int64_t look, std::int64_t step) const {
  double rate = 0;
  for (std::size_t s = 0; s < growth_.size(); ++s) {
    if (coordinates_[s]) {
      rate += measured_[2 * s] + measured_[2 * s + 1] * static_cast<double>(step + 2 - look);
    } else {
      const double root =
          root_energy_[s] + growth_[s] * static_cast<double>(step + 2 - energy_step_);
      rate += rate_norm_[s] * root;
    }
  }
  return rate;
}

void GapWatch::looked(std::int64_t step, double clearance, bool touching) {
  if (touching) last_touch_ = step;
  next_look_ = touching ? step : step + 1;
  if (touching || clearance <= 0 || !can_wait(step)) return;
  // The bound rises with time: its value at the last step holds for all steps before.
  const auto reaches = [&](std::int64_t steps) {
    return time_step_ * static_cast<double>(steps) * rate_bound(step, step + steps) >= clearance;
  };
  std::int64_t low = 1;
  while (low < 100000 && !reaches(2 * low)) low *= 2;
  std::int64_t high = 2 * low;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (reaches(middle) ? high : low) = middle;
  }
  if (!reaches(low)) next_look_ = step + low;
}

CoordinateRates::CoordinateRates(const LinearSystem& system, std::vector<double> rows,
                                 double ground_acceleration, double time_step)
    : time_step_(time_step), filters_(filters_of(system, time_step)), rows_(std::move(rows)) {
  const std::size_t size = system.lumped_mass.size();
  const bool about_rest = damped_about_rest(system);
  rest_ = about_rest ? system.rest_displacement : std::vector<double>(size, 0.0);
  const Vector3& g = system.gravity;
  std::vector<double> stiffness(size);
  const VecHandle diagonal = wrap_vector(system, stiffness);
  POUNDING_PETSC(MatGetDiagonal(system.stiffness->matrix(), diagonal.get()));
  std::vector<double> growth(size);
  const double at_rest = system.uniform_damping ? system.uniform_damping->at_rest() : 1;
  branch_over_a_.resize(system.uniform_damping ? system.uniform_damping->filters.size() : 0);
  for (std::size_t i = 0; i < size; ++i) {
    const double m = system.lumped_mass[i];
    const double k = stiffness[i];
    const double c = system.damping.alpha * m + system.damping.beta * k;
    const double a = m - time_step / 2 * c - time_step * time_step / 4 * system.stiffening() * k;
    const auto& iota = system.generalised->influence;
    const double participation = m * std::hypot(iota[0][i], iota[1][i], iota[2][i]);
    double force = participation * (ground_acceleration + std::hypot(g[0], g[1], g[2]));
    if (about_rest) {
      const double weight = m * (iota[0][i] * g[0] + iota[1][i] * g[1] + iota[2][i] * g[2]);
      force = participation * ground_acceleration + std::abs(weight - k * rest_[i]);
    }
    stiffness_over_a_.push_back(at_rest * k / a);
    compliance_.push_back(k > 0 ? 1 / k : 0);
    for (std::size_t b = 0; b < branch_over_a_.size(); ++b) {
      branch_over_a_[b].push_back(at_rest * system.uniform_damping->filters[b].weight * k / a);
    }
    growth[i] = time_step * force / a;
  }
  for (double& value : rows_) value = std::abs(value);
  rates_.resize(size == 0 ? 0 : rows_.size() / size);
  speeds_.resize(size);
  growth_ = largest(growth);
}

double CoordinateRates::rate(const StructureState& state) {
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    const double v = state.velocity[i];
    const double mean = state.displacement[i] - time_step_ / 2 * v;
    const double moved = mean - rest_[i];
    double square = v * v + stiffness_over_a_[i] * (moved * moved);
    const double before = state.displacement[i] - time_step_ * v;  // u_{n-1}
    for (std::size_t b = 0; b < branch_over_a_.size(); ++b) {
      // Z^n = k W^{n-1} + t Q_{n-1}; W^{n-1} does not matter if k is zero.
      const auto& filter = filters_.filters[b];
      if (filter.keep == 0) continue;
      const double passed =
          (state.filtered[b][i] * compliance_[i] - filter.newest() * before) / filter.keep;
      const double branch = mean - passed;
      square += branch_over_a_[b][i] * (branch * branch);
    }
    speeds_[i] = std::sqrt(square);
  }
  return largest(speeds_);
}

double CoordinateRates::largest(const std::vector<double>& speeds) {
  multiply_rows(rows_.data(), rates_.size(), speeds.size(), speeds.data(), rates_.data(), 1);
  const double found = rates_.empty() ? 0.0 : *std::max_element(rates_.begin(), rates_.end());
  return found * above_round_off;
}

}  // namespace pounding
