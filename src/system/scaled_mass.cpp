#include "system/scaled_mass.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/parallel.h"
#include "mesh/location.h"
#include "stiffness/element_loop.h"

namespace pounding {

namespace {

void add_load(const AddedMass& water, WaterLoad& load) {
  for (std::size_t n = 0; n < water.nodes().size(); ++n) {
    for (int c = 0; c < std::min(water.nodes()[n].count, 3); ++c) {
      load.dofs.push_back(water.nodes()[n].begin + c);
      for (std::size_t d = 0; d < 3; ++d) load.force[d].push_back(water.ground_force(d)[n][c]);
    }
  }
}

}  // namespace

double ScaledMass::add(const ElementBlock& block, std::size_t element, const Region& region,
                       std::span<const double> stiffness, std::span<const double> mass) {
  if (meets_rigid_body(mesh_, block, element)) {
    add_rows(block, element, stiffness);
    return 0;
  }
  if (!may_scale(structure_, block.type)) return 0;
  const std::span<double> added(added_.data(), stiffness.size());
  std::fill(added.begin(), added.end(), 0.0);
  const double factor =
      add_element_mass(structure_.mass_scaling, structure_.damping_of(region), stiffness, mass,
                       added, structure_.stiffening(), holding_part(block.type));
  if (factor > 0) {
    report_.elements += block.counted[element];
    report_.largest_factor = std::max(report_.largest_factor, factor);
    add_blocks(block, element);
    add_rows(block, element, stiffness);
  }
  return factor;
}

void ScaledMass::add_blocks(const ElementBlock& block, std::size_t element) {
  const ElementLayout layout = element_layout(block.type);
  const std::size_t components = layout.components;
  const stiffness::ElementDofs dofs(mesh_, block, element);
  const std::size_t size = dofs.size();
  const auto node_at = [&](std::size_t a) {
    return block.connectivity[element * static_cast<std::size_t>(layout.nodes) + a / components];
  };
  const auto place_at = [&](std::size_t i) {
    return static_cast<std::size_t>(dofs[i] - mesh_.first_dof[node_at(i)]);
  };
  const bool here =
      std::ranges::any_of(dofs, [&](LocalIndex dof) { return dof >= 0 && dof < mesh_.owned_dofs; });
  if (here && std::ranges::max(dofs) >= mesh_.owned_dofs) {
    throw std::logic_error(describe_element(mesh_, block, element) +
                           " has scaled mass and lives on several ranks");
  }
  for (std::size_t i = 0; i < size && here; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      if (dofs[i] >= 0 && dofs[j] >= 0 && node_at(i) >= node_at(j)) {
        blocks_[{node_at(i), node_at(j)}][6 * place_at(i) + place_at(j)] += added_[i * size + j];
      }
    }
  }
}

void ScaledMass::add_rows(const ElementBlock& block, std::size_t element,
                          std::span<const double> stiffness) {
  const stiffness::ElementDofs dofs(mesh_, block, element);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (dofs[i] < 0 || dofs[i] >= mesh_.owned_dofs) continue;
    double& sum = row_sums_[dofs[i]];
    for (const double k : stiffness.subspan(i * dofs.size(), dofs.size())) sum += std::abs(k);
  }
}

void ScaledMass::finish(LinearSystem& system) {
  NodeBlocks added;
  std::map<LocalIndex, int> number;
  for (const auto& [pair, block] : blocks_) {
    for (const LocalIndex node : pair) number[node] = 0;
  }
  for (auto& [node, place] : number) {
    const std::size_t n = node;
    place = static_cast<int>(added.nodes.size());
    added.nodes.push_back({mesh_.first_dof[n], component_count(mesh_.free_components[n])});
    report_.dofs += added.nodes.back().count;
  }
  for (const auto& [pair, block] : blocks_) {
    added.blocks[{number.at(pair[0]), number.at(pair[1])}] = block;
  }
  for (const auto& [dof, sum] : row_sums_) {
    report_.row_frequency =
        std::max(report_.row_frequency, std::sqrt(sum / system.lumped_mass[dof]));
  }
  std::vector<RigidBody> bodies;
  for (const RigidPart& part : mesh_.rigid) {
    if (part.kind == RigidKind::tie) continue;
    if (bodies_.empty() || bodies_.back().group != part.group) {
      bodies_.push_back({part.group, part.kind});
    }
    if (part.nodes.empty()) continue;
    const RigidBody& body = bodies.emplace_back(mesh_, part, system.lumped_mass);
    RigidBodyReport& report = bodies_.back();
    ++report.bodies;
    report.nodes += part.global_nodes;
    report.motions += static_cast<GlobalIndex>(body.motions());
    report.dofs += static_cast<GlobalIndex>(body.dofs().size());
    for (const LocalIndex node : part.nodes) {
      const LocalIndex dof = mesh_.dof(node, 0);
      report.mass += dof < 0 ? 0 : system.lumped_mass[dof];
    }
  }
  std::vector<TiedPart> ties = make_ties(system.lumped_mass);
  std::vector<AddedMass> waters;
  for (const WaterBody& water : mesh_.water) {
    waters.emplace_back(mesh_, water, system.lumped_mass);
    add_load(waters.back(), system.water);
    if (waters.back().nodes().empty()) waters.pop_back();
  }
  if (!added.nodes.empty() || !bodies.empty() || !ties.empty() || !waters.empty()) {
    system.coupled_mass =
        std::make_unique<CoupledMass>(system.lumped_mass, std::move(added), std::move(bodies),
                                      std::move(ties), std::move(waters));
  }
}

std::vector<TiedPart> ScaledMass::make_ties(std::span<const double> lumped_mass) {
  std::map<int, std::size_t> report_of;  // by rigid group
  for (std::size_t r = 0; r < structure_.rigid_groups.size(); ++r) {
    const RigidGroup& group = structure_.rigid_groups[r];
    if (group.kind != RigidKind::tie) continue;
    report_of[static_cast<int>(r)] = bodies_.size();
    bodies_.push_back({group.name(), group.kind});
  }
  std::vector<TiedPart> ties;
  for (const RigidPart& part : mesh_.rigid) {
    if (part.kind != RigidKind::tie || part.nodes.empty()) continue;
    ties.emplace_back(mesh_, part, lumped_mass);
    std::set<int> groups;
    for (const TiedNode& tied : part.tied) {
      const LocalIndex node = mesh_.owned_node(tied.node);
      RigidBodyReport& report = bodies_[report_of.at(tied.group)];
      report.bodies += groups.insert(tied.group).second ? 1 : 0;
      ++report.nodes;
      report.dofs += component_count(mesh_.free_components[node]);
      const LocalIndex dof = mesh_.dof(node, 0);
      report.mass += dof < 0 ? 0 : lumped_mass[dof];
    }
  }
  return ties;
}

void ScaledMass::share(LinearSystem& system) const {
  MassScaling& report = system.mass_scaling;
  report = report_;
  report.time_step = structure_.mass_scaling;
  reduce_over_ranks(mesh_.comm, MPI_SUM, report.elements, report.dofs);
  reduce_over_ranks(mesh_.comm, MPI_MAX, report.largest_factor, report.row_frequency);
  system.rigid_bodies = bodies_;
  for (RigidBodyReport& body : system.rigid_bodies) {
    reduce_over_ranks(mesh_.comm, MPI_SUM, body.bodies, body.nodes, body.dofs, body.motions,
                      body.mass);
  }
}

}  // namespace pounding
