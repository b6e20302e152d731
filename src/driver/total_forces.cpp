#include "driver/total_forces.h"

#include "dynamics/structure_step.h"
#include "system/links.h"

namespace pounding {

TotalForce::TotalForce(const ForceItem& item, const LinearSystem& system, const Mesh& mesh,
                       double time_step)
    : system_(system), time_step_(time_step), point_(item.point()) {
  std::vector<Counted> of_dof(mesh.owned_dofs, {-1, 0, {}});
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    const Vector3 x = mesh.position(node);
    for (int c = 0; c < 6; ++c) {
      if (!counts(item, mesh.free_components[node], x, c)) continue;
      const LocalIndex dof = mesh.dof(node, c);
      of_dof[dof] = {dof, c, x};
    }
  }
  for (const Counted& counted : of_dof) {
    if (counted.dof >= 0 && !system.generalised) counted_.push_back(counted);
  }
  for (std::size_t b = 0; system.links && b < system.links->links().size(); ++b) {
    const Link& link = system.links->links()[b];
    Wrench& unit = links_.emplace_back();
    for (std::size_t i = 0; i < link.place.size(); ++i) {
      if (link.place[i] < 0) continue;
      const Counted& counted =
          of_dof[system.links->dofs()[static_cast<std::size_t>(link.place[i])]];
      if (counted.dof >= 0) add_force(counted, link.weight[i], unit);
    }
  }
}

Wrench TotalForce::sum(std::span<const double> force) const {
  Wrench total{};
  for (const Counted& counted : counted_) add_force(counted, force[counted.dof], total);
  return total;
}

void TotalForce::begin(const StructureState& state) {
  before_ = sum(state.stiffness_displacement);
}

void TotalForce::add(const StructureState& state, const LinkStep* links, Wrench& total) const {
  const auto take = [&total](double factor, const Wrench& part) {
    for (std::size_t k = 0; k < part.size(); ++k) total[k] -= factor * part[k];
  };
  if (!counted_.empty()) {
    const Wrench now = sum(state.stiffness_displacement);
    if (state.filtered.empty()) {
      const double share = system_.damping.beta / time_step_;  // K v- = (K u_n - K u_{n-1}) / dt
      take(1 + share, now);
      take(-share, before_);
    } else {
      const Filters<double> filters = filters_of(system_, time_step_);
      take(filters.at_once, now);
      for (std::size_t i = 0; i < filters.count; ++i) {
        take(-filters.filters[i].weight, sum(state.filtered[i]));
      }
    }
    if (!state.extra_force.empty()) take(1, sum(state.extra_force));
  }
  for (std::size_t b = 0; links != nullptr && b < links_.size(); ++b) {
    take(links->force(b), links_[b]);
  }
}

}  // namespace pounding
