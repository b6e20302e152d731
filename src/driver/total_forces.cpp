#include "driver/total_forces.h"

#include "system/links.h"

namespace pounding {

TotalForce::TotalForce(const ForceItem& item, const LinearSystem& system, const Mesh& mesh)
    : point_(item.point()) {
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

std::vector<LocalIndex> TotalForce::dofs() const {
  std::vector<LocalIndex> dofs;
  for (const Counted& counted : counted_) dofs.push_back(counted.dof);
  return dofs;
}

void TotalForce::add(const StructureState& state, const KeptForces& forces,
                     const interactions::StructureLinks* links, Wrench& total) const {
  for (const Counted& counted : counted_) {
    double force = forces.at(counted.dof).acting;
    if (!state.extra_force.empty()) force += state.extra_force[counted.dof];
    if (!state.inelastic_force.empty()) force += state.inelastic_force[counted.dof];
    add_force(counted, -force, total);
  }
  for (std::size_t b = 0; links != nullptr && b < links_.size(); ++b) {
    const double force = links->force(b);
    for (std::size_t k = 0; k < total.size(); ++k) total[k] -= force * links_[b][k];
  }
}

}  // namespace pounding
