#include "dynamics/coupled_step.h"

#include <algorithm>
#include <type_traits>

#include "common/lanes.h"

namespace pounding {
namespace {

/// Single values go like vectors.
void load(const double* from, double& to) {
  to = *from;
}
void store(double* to, double from) {
  *to = from;
}

}  // namespace

CoupledStep::CoupledStep(const LinearSystem& system, StructureState& state,
                         const Filters<double>& filters)
    : system_(system), state_(state), filters_(filters) {
  const CoupledMass& mass = *system.coupled_mass;
  std::size_t force = 0;
  for (std::size_t n = 0; n < mass.nodes().size(); ++n) {
    Node node;
    node.begin = static_cast<std::size_t>(mass.nodes()[n].begin);
    node.count = static_cast<std::size_t>(mass.nodes()[n].count);
    node.force = force;
    node.field = mass.place(n);
    node.regular = node.count == 6 && !system.extra_damping;
    for (std::size_t c = 0; c < node.count; ++c) {
      const int expected = c < 3 ? static_cast<int>(c) : -1;
      const bool apart = !system.inelastic.empty() && system.inelastic[node.begin + c] != 0;
      node.regular = node.regular && !apart && system.direction[node.begin + c] == expected;
    }
    nodes_.push_back(node);
    force += node.count;
  }
  force_.assign(force, 0.0);
  filtered_.assign(system.uniform_damping ? force : 0, 0.0);
  field_.assign(mass.field_size(), 0.0);
}

void CoupledStep::keep(std::size_t place, std::size_t count, const double* force) {
  std::copy(force, force + count, force_.begin() + static_cast<std::ptrdiff_t>(place));
}

void CoupledStep::advance(const StepTerms<double>& terms, const std::array<double, 3>& ground_step,
                          std::span<const double> known_step, const double* stiffness_velocity,
                          DofSums<double>& dof_sums, DofEnergies<double>& dof_energies,
                          StepSums& sums) {
  const bool with_energies = stiffness_velocity != nullptr;
  if (with_energies) {
    sums.added_kinetic_before += system_.coupled_mass->added_product(state_.velocity.data());
  }
  filter_forces();
  form_impulses(terms, ground_step);
  if (!known_step.empty()) add_known_loads(known_step);
  system_.coupled_mass->solve(field_.data());
  if (with_energies) {
    settle_nodes<true>(terms, stiffness_velocity, dof_sums, dof_energies, sums);
  } else {
    settle_nodes<false>(terms, stiffness_velocity, dof_sums, dof_energies, sums);
  }
  sums.filtered += filtered_work();
  if (!known_step.empty()) sums.support_input += known_work(known_step);
}

void CoupledStep::add_known_loads(std::span<const double> known_step) {
  for (const Node& node : nodes_) {
    for (std::size_t c = 0; c < node.count; ++c) {
      const std::size_t i = node.begin + c;
      field_[node.field + c] -= system_.lumped_mass[i] * known_step[i];
    }
  }
}

double CoupledStep::known_work(std::span<const double> known_step) const {
  double work = 0;
  for (const Node& node : nodes_) {
    for (std::size_t c = 0; c < node.count; ++c) {
      const std::size_t i = node.begin + c;
      const double sum = 2 * state_.velocity[i] - field_[node.field + c];
      work -= known_step[i] * system_.lumped_mass[i] * sum / 2;
    }
  }
  return work;
}

void CoupledStep::filter_forces() {
  if (filtered_.empty()) return;
  const auto vectors = in_lanes<Lanes>(filters_);
  const auto filter = [this]<typename Value>(const Node& node, std::size_t c,
                                             const Filters<Value>& filters) {
    const std::size_t i = node.begin + c;
    Value q;
    load(&force_[node.force + c], q);
    if constexpr (std::is_same_v<Value, double>) q += inelastic(i);
    Value f = filters.passing * q;
    for (std::size_t k = 0; k < filters.count; ++k) {
      Value memory;
      load(&state_.filtered[k][i], memory);
      pass_filter(filters.filters[k], q, memory, f);
      store(&state_.filtered[k][i], memory);
    }
    store(&filtered_[node.force + c], f);
  };
  for (const Node& node : nodes_) {
    if (node.regular) filter(node, 0, vectors);
    for (std::size_t c = node.regular ? lane_count : 0; c < node.count; ++c) {
      filter(node, c, filters_);
    }
  }
}

double CoupledStep::filtered_work() const {
  double work = 0;
  for (const Node& node : nodes_) {
    for (std::size_t c = 0; !filtered_.empty() && c < node.count; ++c) {
      const double sum = 2 * state_.velocity[node.begin + c] - field_[node.field + c];
      const double q = force_[node.force + c] + inelastic(node.begin + c);
      work += (filtered_[node.force + c] - q) * sum;
    }
  }
  return work;
}

void CoupledStep::form_regular(const Node& node, const StepTerms<double>& terms,
                               const std::array<double, 3>& ground_step) {
  const std::vector<double>& acting = filtered_.empty() ? force_ : filtered_;
  const auto form = [&](auto vector, std::size_t first, const auto& ground) {
    auto q = vector;
    auto v = vector;
    auto m = vector;
    load(&acting[node.force + first], q);
    load(&state_.velocity[node.begin + first], v);
    load(&system_.lumped_mass[node.begin + first], m);
    const double decay = terms.duration * system_.damping.alpha;
    store(&field_[node.field + first], -(m * (decay * v + ground)) - terms.duration * q);
  };
  form(Lanes{}, 0, Lanes{ground_step[0], ground_step[1], ground_step[2], 0});
  form(HalfLanes{}, lane_count, HalfLanes{});
}

void CoupledStep::form_impulses(const StepTerms<double>& terms,
                                const std::array<double, 3>& ground_step) {
  const std::vector<double>& acting = filtered_.empty() ? force_ : filtered_;
  const double decay = terms.duration * system_.damping.alpha;
  for (const Node& node : nodes_) {
    if (node.regular) {
      form_regular(node, terms, ground_step);
      continue;
    }
    for (std::size_t c = 0; c < CoupledMass::width; ++c) {
      const std::size_t i = node.begin + c;
      double impulse = 0;  // components that are no dof stay at rest
      if (c < node.count) {
        const int direction = system_.direction[i];
        const double ground = direction < 0 ? 0 : ground_step[direction];
        impulse = -(system_.lumped_mass[i] * (decay * state_.velocity[i] + ground)) -
                  terms.duration * acting[node.force + c];
        if (filtered_.empty()) impulse -= terms.duration * inelastic(i);
        if (!state_.extra_force.empty()) impulse -= terms.duration * state_.extra_force[i];
      }
      field_[node.field + c] = impulse;
    }
  }
}

template <bool with_energies>
void CoupledStep::settle_nodes(const StepTerms<double>& terms, const double* stiffness_velocity,
                               DofSums<double>& dof_sums, DofEnergies<double>& dof_energies,
                               StepSums& sums) {
  DofSums<Lanes> low_sums;
  DofSums<HalfLanes> high_sums;
  DofEnergies<Lanes> low_energies;
  DofEnergies<HalfLanes> high_energies;
  Lanes momentum{};
  const auto settle_part = [&]<typename Vector>(
                               const Node& node, std::size_t first, const StepTerms<Vector>& all,
                               DofSums<Vector>& part_sums, DofEnergies<Vector>& part_energies) {
    const std::size_t i = node.begin + first;
    Vector q, mass, change;
    DofState<Vector> dof;
    load(&force_[node.force + first], q);
    load(&field_[node.field + first], change);
    load(&system_.lumped_mass[i], mass);
    load(&state_.displacement[i], dof.displacement);
    load(&state_.velocity[i], dof.velocity);
    if constexpr (with_energies) {
      Vector rate;
      load(stiffness_velocity + i, rate);
      add_energies(all, mass, q, rate, dof, part_energies);
    }
    const Vector both = settle(all, q, Vector(dof.velocity + change), mass, dof, part_sums);
    store(&state_.displacement[i], dof.displacement);
    store(&state_.velocity[i], dof.velocity);
    return both;
  };
  const auto low = in_lanes<Lanes>(terms);
  const auto high = in_lanes<HalfLanes>(terms);
  for (const Node& node : nodes_) {
    if (node.regular) {
      momentum += settle_part(node, 0, low, low_sums, low_energies);
      settle_part(node, lane_count, high, high_sums, high_energies);
    } else {
      settle_dofs<with_energies>(node, terms, stiffness_velocity, dof_sums, dof_energies, sums);
    }
  }
  add_to(low_sums, sums);
  add_to(high_sums, sums);
  add_to(low_energies, sums);
  add_to(high_energies, sums);
  for (std::size_t d = 0; d < 3; ++d) sums.momentum[d] += momentum[d];
}

template <bool with_energies>
void CoupledStep::settle_dofs(const Node& node, const StepTerms<double>& terms,
                              const double* stiffness_velocity, DofSums<double>& dof_sums,
                              DofEnergies<double>& dof_energies, StepSums& sums) {
  for (std::size_t c = 0; c < node.count; ++c) {
    const std::size_t i = node.begin + c;
    DofState<double> dof{state_.displacement[i], state_.velocity[i]};
    const double mass = system_.lumped_mass[i];
    const double before = dof.velocity;
    const double after = before + field_[node.field + c];
    const double q = force_[node.force + c];
    if constexpr (with_energies) {
      add_energies(terms, mass, q, stiffness_velocity[i], dof, dof_energies);
    }
    const double momentum = settle(terms, q, after, mass, dof, dof_sums);
    state_.displacement[i] = dof.displacement;
    state_.velocity[i] = dof.velocity;
    if (system_.direction[i] >= 0) sums.momentum[system_.direction[i]] += momentum;
    if (!state_.extra_force.empty()) sums.device += state_.extra_force[i] * (after + before);
  }
}

}  // namespace pounding
