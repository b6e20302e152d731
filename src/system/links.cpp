#include "system/links.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "common/error.h"
#include "common/integer_sets.h"
#include "common/parallel.h"
#include "elements/element_traits.h"
#include "mesh/location.h"
#include "system/support_shapes.h"

namespace pounding {
std::unique_ptr<Links> Links::build(const Structure& structure, const Mesh& mesh) {
  std::unique_ptr<Links> found(new Links);
  GlobalIndex count = 0;  // of all ranks
  for (const ElementBlock& block : mesh.blocks) {
    if (!interactions::has_links(structure.regions[block.region])) continue;
    count += block.global_count;
    for (std::size_t e = 0; e < block.count(); ++e) {
      if (block.type == ElementType::soil) {
        found->add_soil(structure, mesh, block, e);
      } else if (is_spring(block.type)) {
        found->add_springs(structure, mesh, block, e);
      } else {
        found->add_bar(structure, mesh, block, e);
      }
    }
  }
  for (const AbsorbingNode& absorbing : mesh.absorbing) found->add_absorbing(mesh, absorbing);
  if (count == 0 && structure.absorbing.empty()) return nullptr;
  on_every_rank(mesh.comm, [&] { found->refuse_unpressed(structure); });
  found->driven_ = structure.is_driven_from_below();
  std::vector<LocalIndex>& dofs = found->dofs_;
  keep_once(dofs);
  for (Link& link : found->links_) {
    for (int& point : link.point) {
      if (point < 0) continue;
      point = static_cast<int>(std::ranges::lower_bound(dofs, point) - dofs.begin());
    }
  }
  return found;
}

void Links::refuse_unpressed(const Structure& structure) const {
  std::set<std::int64_t> pressed;
  for (const Link& link : links_) {
    if (link.origin.part == interactions::SpringPart::gauge) pressed.insert(link.number);
  }
  for (const Link& link : links_) {
    if (link.origin.region == nullptr || !(link.origin.region->nonlinear.friction > 0) ||
        link.origin.part != interactions::SpringPart::stiffness || pressed.contains(link.number)) {
      continue;
    }
    throw UserError("structure " + structure.name + ": element " + std::to_string(link.number) +
                    " of group '" + link.origin.region->group +
                    "' slides, but its ends are clamped across the plane in which it does, so "
                    "nothing presses on it");
  }
}

void Links::add_bar(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
                    std::size_t element) {
  const Region& region = structure.regions[block.region];
  const LocalIndex* nodes = &block.connectivity[2 * element];
  const Vector3 a = mesh.position(nodes[0]);
  const Vector3 b = mesh.position(nodes[1]);
  Link link;
  link.number = block.tags[element];
  const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  // The modes of a reduced structure have every bar taut, and their damping is the bars' as well.
  const bool reduced = structure.modal.has_value();
  // The elongation of one that resists shortening only is how far it is shortened.
  const double sign = region.compression_only ? -1 : 1;
  const double beta = reduced ? 0 : structure.damping_of(region).beta;
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t end = 0; end < 2; ++end) {
      link.point[3 * end + d] = mesh.dof(nodes[end], static_cast<int>(d));
      link.weight[3 * end + d] = (end == 0 ? -sign : sign) * (b[d] - a[d]) / length;
      if (link.point[3 * end + d] < 0) {
        link.held.push_back({nodes[end], static_cast<int>(d), link.weight[3 * end + d]});
      }
    }
  }
  for (const auto& [component, part] : interactions::spring_links(region)) {
    const bool held = reduced && part == interactions::SpringPart::stiffness;
    link.origin = {&region, component, length, beta, held, part};
    keep(mesh, block, element, link);
  }
}

void Links::add_springs(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
                        std::size_t element) {
  const Region& region = structure.regions[block.region];
  const std::size_t ends = element_layout(block.type).nodes;
  const LocalIndex* nodes = &block.connectivity[ends * element];
  const bool reduced = structure.modal.has_value();
  for (const auto& [component, part] : interactions::spring_links(region)) {
    const auto c = static_cast<std::size_t>(component);
    Link link;
    link.number = block.tags[element];
    link.origin = {&region, component, 0, 0, false, part};
    link.origin.share = block.share_of(element);
    const bool pressed = interactions::is_pressed(link.origin);
    if (pressed) link.origin.beta = reduced ? 0 : structure.damping.beta;
    link.origin.in_stiffness = reduced && part == interactions::SpringPart::stiffness;
    for (std::size_t end = 0; end < ends; ++end) {
      link.point[end] = mesh.dof(nodes[end], component);
      link.weight[end] = end + 1 == ends && !pressed ? 1 : -1;
    }
    if (part == interactions::SpringPart::gauge && structure.gravity[c] > 0) {
      for (double& weight : link.weight) weight = -weight;  // weight presses it towards greater c
    }
    for (std::size_t end = 0; end < ends; ++end) {
      if (link.point[end] < 0) {
        link.held.push_back({nodes[end], component, link.weight[end]});
      }
      if (ends == 1) {
        link.held.push_back({nodes[end], component, -link.weight[end], true});
      }
    }
    keep(mesh, block, element, link);
  }
}

void Links::add_soil(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
                     std::size_t element) {
  const Region& region = structure.regions[block.region];
  const Foundation& foundation = *region.foundation;
  for (std::size_t c = 0; c < foundation.impedances.size(); ++c) {
    if (foundation.impedances[c].impedance.is_spring()) continue;
    const auto& motion = foundation.springs[c].motion;
    Link link;
    link.number = block.tags[element];
    link.origin = {&region, static_cast<int>(c), 0, 0, false};
    for (std::size_t i = 0; i < motion.size(); ++i) {
      if (motion[i] == 0) continue;
      const LocalIndex node = block.connectivity[element];
      const auto component = static_cast<int>(i);
      link.point[i] = mesh.dof(node, component);
      link.weight[i] = motion[i];
      if (link.point[i] >= 0) link.held.push_back({node, component, -motion[i], true});
    }
    keep(mesh, block, element, link);
  }
}

void Links::add_absorbing(const Mesh& mesh, const AbsorbingNode& absorbing) {
  const LocalIndex node = mesh.owned_node(absorbing.node);
  for (std::size_t k = 0; k < absorbing.axis.size(); ++k) {
    Link link;
    link.number = absorbing.node;
    const std::size_t width = absorbing.incident.size() / 3;
    const auto incident = std::span(absorbing.incident).subspan(k * width, width);
    if (std::ranges::any_of(incident, [](double w) { return w != 0; })) {
      link.incident.assign(incident.begin(), incident.end());
    }
    link.origin.component = static_cast<int>(k);
    link.origin.absorbing = absorbing.dashpot[k];
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex dof = mesh.dof(node, static_cast<int>(c));
      if (dof < 0 || absorbing.axis[k][c] == 0) continue;
      link.point[c] = dof;
      link.weight[c] = absorbing.axis[k][c];
      dofs_.push_back(dof);
    }
    if (std::ranges::any_of(link.point, [](int dof) { return dof >= 0; })) links_.push_back(link);
  }
}

void Links::keep(const Mesh& mesh, const ElementBlock& block, std::size_t element,
                 const Link& link) {
  const bool here =
      std::ranges::any_of(link.point, [&](int dof) { return dof >= 0 && dof < mesh.owned_dofs; });
  const bool elsewhere =
      std::ranges::any_of(link.point, [&](int dof) { return dof >= mesh.owned_dofs; });
  if (here && elsewhere) {
    throw std::logic_error(describe_element(mesh, block, element) +
                           " is a link and lives on several ranks");
  }
  if (here) {
    std::ranges::copy_if(link.point, std::back_inserter(dofs_), [](int dof) { return dof >= 0; });
    links_.push_back(link);
  }
}

void Links::find_trace(const LinearSystem& system, const Mesh& mesh) {
  points_ = points_of(mesh, dofs_);
  trace_ = std::make_unique<Trace>(system, mesh, points_, true);
  for (Link& link : links_) {
    link.supports.clear();
    for (std::size_t c = 0; system.supports && c < system.supports->columns.size(); ++c) {
      const SupportColumn& column = system.supports->columns[c];
      double& sum = link.supports.emplace_back(0.0);
      for (const HeldEnd& end : link.held) {
        sum +=
            end.weight * (end.ground ? ground_displacement(column, mesh, end.node, end.component)
                                     : support_displacement(column, mesh, end.node, end.component));
      }
    }
  }
}

std::vector<TracePoint> section_points(const Structure& structure, const GlobalMesh& mesh) {
  std::vector<TracePoint> points;
  for (const ElementSet& set : mesh.regions) {
    if (!is_beam(set.type) || !has_element_law(structure.regions[set.region])) continue;
    for (const GlobalIndex node : set.connectivity) {
      for (int c = 0; c < 6; ++c) points.push_back({node, c});
    }
  }
  return points;
}

std::vector<TracePoint> wave_points(const Structure& structure, const GlobalMesh& mesh) {
  std::vector<TracePoint> points;
  for (const ElementSet& set : mesh.regions) {
    const Region& region = structure.regions[set.region];
    if (!region.of_water || set.type != ElementType::spring) continue;
    const int direction = region.mass_along[0] > 0 ? 0 : 1;
    for (const GlobalIndex node : set.connectivity) points.push_back({node, direction});
  }
  return points;
}

std::vector<TracePoint> link_points(const Structure& structure, const GlobalMesh& mesh) {
  std::vector<TracePoint> points;
  for (const ElementSet& set : mesh.regions) {
    const Region& region = structure.regions[set.region];
    if (!interactions::has_links(region)) continue;
    const auto springs = interactions::spring_links(region);
    for (const GlobalIndex node : set.connectivity) {
      for (int c = 0; c < 6; ++c) {
        const bool pulls =
            region.foundation ||
            (is_spring(set.type)
                 ? region.nonlinear.yields(static_cast<std::size_t>(c)) ||
                       std::ranges::find(springs, c, &interactions::SpringLink::component) !=
                           springs.end()
                 : c < 3);
        if (pulls) points.push_back({node, c});
      }
    }
  }
  return points;
}

}  // namespace pounding
