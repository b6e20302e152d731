#include "dynamics/coupled_step.h"

#include <algorithm>

#include "common/lanes.h"

namespace pounding {
namespace {

/// Sums of the regular nodes in one of the two vectors that a node's dofs fill.
template <typename Vector>
struct VectorSums {
  Vector stiffness_before{};
  Vector stiffness_across{};
  Vector mass_sum{};
  Vector momentum{};
};

template <typename Vector>
void add_to(const VectorSums<Vector>& from, StepSums& sums) {
  sums.stiffness_before += add_up(from.stiffness_before);
  sums.stiffness_across += add_up(from.stiffness_across);
  sums.mass_sum += add_up(from.mass_sum);
}

}  // namespace

CoupledStep::CoupledStep(const LinearSystem& system, BodyState& state, double time_step)
    : system_(system), state_(state), time_step_(time_step) {
  const CoupledMass& mass = *system.coupled_mass;
  std::size_t force = 0;
  for (std::size_t n = 0; n < mass.nodes().size(); ++n) {
    Node node;
    node.begin = static_cast<std::size_t>(mass.nodes()[n].begin);
    node.count = static_cast<std::size_t>(mass.nodes()[n].count);
    node.force = force;
    node.field = mass.place(n);
    node.regular = node.count == 6 && !system.has_devices();
    for (std::size_t c = 0; c < node.count; ++c) {
      const int expected = c < 3 ? static_cast<int>(c) : -1;
      node.regular = node.regular && system.direction[node.begin + c] == expected;
    }
    nodes_.push_back(node);
    force += node.count;
  }
  force_.assign(force, 0.0);
  field_.assign(mass.field_size(), 0.0);
}

void CoupledStep::keep(std::size_t place, std::size_t count, const double* force) {
  std::copy(force, force + count, force_.begin() + static_cast<std::ptrdiff_t>(place));
}

void CoupledStep::advance(const Terms& terms, bool with_energies, StepSums& sums) {
  if (with_energies) {
    add_energies(sums);
  }
  form_impulses(terms);
  system_.coupled_mass->solve(field_.data());
  advance_regular(terms, sums);
  for (const Node& node : nodes_) {
    if (!node.regular) {
      advance_dofs(node, terms, sums);
    }
  }
}

void CoupledStep::add_energies(StepSums& sums) const {
  for (const Node& node : nodes_) {
    for (std::size_t i = node.begin; i < node.begin + node.count; ++i) {
      const double mass = system_.lumped_mass[i];
      sums.kinetic_before += mass * state_.velocity[i] * state_.velocity[i];
      sums.strain_before += state_.displacement[i] * state_.stiffness_displacement[i];
      sums.displacement_mass += mass * state_.displacement[i] * state_.displacement[i];
    }
  }
  sums.added_kinetic_before += system_.coupled_mass->added_product(state_.velocity.data());
}

void CoupledStep::form_regular(const Node& node, const Terms& terms) {
  const auto form = [&](auto vector, std::size_t first, const auto& ground) {
    auto q = vector;
    auto v = vector;
    auto m = vector;
    load(&force_[node.force + first], q);
    load(&state_.velocity[node.begin + first], v);
    load(&system_.lumped_mass[node.begin + first], m);
    const double decay = terms.duration * system_.damping.alpha;
    store(&field_[node.field + first], -(m * (decay * v + ground)) - terms.duration * q);
  };
  const auto& g = terms.ground_step;
  form(Lanes{}, 0, Lanes{g[0], g[1], g[2], 0});
  form(HalfLanes{}, lane_count, HalfLanes{});
}

void CoupledStep::form_impulses(const Terms& terms) {
  const double decay = terms.duration * system_.damping.alpha;
  for (const Node& node : nodes_) {
    if (node.regular) {
      form_regular(node, terms);
      continue;
    }
    for (std::size_t c = 0; c < CoupledMass::width; ++c) {
      const std::size_t i = node.begin + c;
      double impulse = 0;  // what is no dof stays at rest
      if (c < node.count) {
        const int direction = system_.direction[i];
        const double ground =
            direction < 0 ? 0 : terms.ground_step[static_cast<std::size_t>(direction)];
        impulse = -(system_.lumped_mass[i] * (decay * state_.velocity[i] + ground)) -
                  terms.duration * force_[node.force + c];
        if (!state_.device_force.empty()) {
          impulse -= terms.duration * state_.device_force[i];
        }
      }
      field_[node.field + c] = impulse;
    }
  }
}

void CoupledStep::advance_regular(const Terms& terms, StepSums& sums) {
  VectorSums<Lanes> low;
  VectorSums<HalfLanes> high;
  const auto advance = [&](const Node& node, std::size_t first, auto& sum) {
    using Vector = decltype(sum.momentum);
    Vector q, u, v, ku, m, change;
    load(&force_[node.force + first], q);
    load(&field_[node.field + first], change);
    load(&state_.displacement[node.begin + first], u);
    load(&state_.velocity[node.begin + first], v);
    load(&state_.stiffness_displacement[node.begin + first], ku);
    load(&system_.lumped_mass[node.begin + first], m);
    const Vector kv = (q - ku) * terms.inverse;
    const Vector after = v + change;
    const Vector step = Vector{} + time_step_;
    add_product(step, kv, ku);
    add_product(step, after, u);
    store(&state_.stiffness_displacement[node.begin + first], ku);
    store(&state_.velocity[node.begin + first], after);
    store(&state_.displacement[node.begin + first], u);
    add_product(v, kv, sum.stiffness_before);
    add_product(after, kv, sum.stiffness_across);
    const Vector both = m * (after + v);
    add_product(both, after + v, sum.mass_sum);
    sum.momentum += both;
  };
  for (const Node& node : nodes_) {
    if (node.regular) {
      advance(node, 0, low);
      advance(node, lane_count, high);
    }
  }
  add_to(low, sums);
  add_to(high, sums);
  for (std::size_t d = 0; d < 3; ++d) {
    sums.momentum[d] += low.momentum[d];
  }
}

void CoupledStep::advance_dofs(const Node& node, const Terms& terms, StepSums& sums) {
  for (std::size_t c = 0; c < node.count; ++c) {
    const std::size_t i = node.begin + c;
    const double before = state_.velocity[i];
    const double after = before + field_[node.field + c];
    double& ku = state_.stiffness_displacement[i];
    const double kv = (force_[node.force + c] - ku) * terms.inverse;
    add_product(time_step_, kv, ku);
    add_product(time_step_, after, state_.displacement[i]);
    state_.velocity[i] = after;
    const double both = system_.lumped_mass[i] * (after + before);
    sums.stiffness_before += before * kv;
    sums.stiffness_across += after * kv;
    sums.mass_sum += both * (after + before);
    if (system_.direction[i] >= 0) {
      sums.momentum[static_cast<std::size_t>(system_.direction[i])] += both;
    }
    if (!state_.device_force.empty()) {
      sums.device += state_.device_force[i] * (after + before);
    }
  }
}

}  // namespace pounding
