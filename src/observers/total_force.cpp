#include "observers/total_force.h"

#include "interactions/dashpot_modes.h"
#include "system/links.h"

namespace pounding {

TotalForce::TotalForce(const ForceItem& item, const LinearSystem& system, const Mesh& mesh,
                       std::span<const interactions::SoilRow> soil, std::size_t structure)
    : point_(item.point()), soil_(soil.size()) {
  std::vector<Counted> of_dof(mesh.owned_dofs, {-1, 0, {}});
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    const Vector3 x = mesh.position(node);
    for (int c = 0; c < 6; ++c) {
      if (!counts(item, mesh.free_components[node], x, c)) continue;
      const LocalIndex dof = mesh.dof(node, c);
      of_dof[dof] = {dof, c, x};
    }
  }
  if (system.generalised) {
    for (LocalIndex q = 0; q < system.owned_dofs(); ++q) watched_.push_back(q);
  }
  for (const Counted& counted : of_dof) {
    if (counted.dof < 0 || system.generalised) continue;
    counted_.push_back(counted);
    watched_.push_back(counted.dof);
  }
  for (std::size_t b = 0; system.links && b < system.links->links().size(); ++b) {
    const Link& link = system.links->links()[b];
    Wrench& unit = links_.emplace_back();
    for (std::size_t i = 0; i < link.point.size(); ++i) {
      if (link.point[i] < 0) continue;
      const Counted& counted =
          of_dof[system.links->dofs()[static_cast<std::size_t>(link.point[i])]];
      if (counted.dof >= 0) add_force(counted, link.weight[i], unit);
    }
  }
  for (std::size_t r = 0; r < soil.size(); ++r) {
    for (const interactions::ConstraintTerm& term : soil[r].terms) {
      if (static_cast<std::size_t>(term.structure) != structure) continue;
      const LocalIndex node = mesh.owned_node(term.node);
      if (node < 0) continue;
      const Counted& counted = of_dof[mesh.dof(node, term.component)];
      if (counted.dof >= 0) add_force(counted, term.coefficient, soil_[r]);
    }
  }
  const auto dashpots = interactions::dashpot_rows(system);
  if (!dashpots) return;
  braked_.resize(static_cast<std::size_t>(system.owned_dofs()));
  for (std::size_t b = 0; b < links_.size(); ++b) {
    for (std::size_t i = 0; i < braked_.size(); ++i) {
      const double rate = dashpots->strengths[b] / 2 * dashpots->rows[b * braked_.size() + i];
      for (std::size_t k = 0; k < links_[b].size(); ++k) braked_[i][k] += rate * links_[b][k];
    }
  }
}

void TotalForce::find_modes(const LinearSystem& system) {
  if (!system.switched) return;
  const std::vector<double> squares = system.switched->squares();
  in_modes_.resize(squares.size());
  for (std::size_t k = 0; k < Wrench{}.size(); ++k) {
    std::vector<double> unit(system.lumped_mass.size());
    for (const Counted& counted : counted_) {
      Wrench wrench{};
      add_force(counted, 1, wrench);
      unit[static_cast<std::size_t>(counted.dof)] = wrench[k];
    }
    const std::vector<double> parts = system.switched->weighted(stiffness_times(system, unit));
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (squares[j] > 0) in_modes_[j][k] = parts[j] / squares[j];
    }
  }
}

void TotalForce::add(const CdLagrange& stepper, std::size_t structure,
                     const interactions::StructureLinks* links,
                     std::span<interactions::InelasticElements* const> inelastic,
                     const interactions::SoilRows* soil, Wrench& total) const {
  const auto take = [&total](double force, const Wrench& unit) {
    for (std::size_t k = 0; k < total.size(); ++k) total[k] -= force * unit[k];
  };
  if (const SwitchedRun* const run = stepper.in_modes(structure)) {
    for (std::size_t j = 0; j < in_modes_.size(); ++j) take(run->coordinate_force(j), in_modes_[j]);
    for (std::size_t b = 0; b < links_.size(); ++b) take(run->link_force(b), links_[b]);
    return;
  }
  const StructureState& state = stepper.state().structures[structure];
  for (const Counted& counted : counted_) {
    double force = stepper.force(structure, counted.dof);
    if (!state.inelastic_force.empty()) force += state.inelastic_force[counted.dof];
    for (const auto* elements : inelastic) force += elements->force_apart(counted.dof);
    add_force(counted, -force, total);
  }
  for (std::size_t b = 0; links != nullptr && b < links_.size(); ++b) {
    take(links->force(b), links_[b]);
  }
  for (std::size_t r = 0; r < soil_.size(); ++r) take(soil->force(r), soil_[r]);
  for (std::size_t i = 0; links == nullptr && i < braked_.size(); ++i) {
    take(stepper.braked(structure, i), braked_[i]);
  }
}

}  // namespace pounding
