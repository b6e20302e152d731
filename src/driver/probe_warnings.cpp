#include <algorithm>
#include <set>
#include <utility>

#include "driver/facts.h"
#include "driver/warnings.h"

namespace pounding {
namespace {

constexpr double far_snap = 0.2;   // of the largest element at the node
constexpr double far_place = 0.5;  // m, however large elements are
constexpr std::size_t share = 4;   // one node in four

using NodeSet = std::set<std::pair<int, GlobalIndex>>;  // structure and node

NodeSet contact_nodes(const interactions::Interface& interface) {
  NodeSet nodes;
  for (const interactions::Constraint& constraint : interface.constraints) {
    for (const interactions::ConstraintTerm& term : constraint.terms) {
      nodes.emplace(term.structure, term.node);
    }
  }
  return nodes;
}

/// "probe roof: 2 of its 4 nodes are"; "probe roof: its node is".
std::string subject(const ResolvedProbe& probe, std::size_t count) {
  if (probe.nodes.size() == 1) return "probe " + probe.name + ": its node is";
  return sentence("probe {}: {} of its {} nodes are", {probe.name, count, probe.nodes.size()});
}

}  // namespace

std::vector<std::string> probe_warnings(std::span<const ResolvedProbe> probes,
                                        std::span<const GlobalMesh> meshes,
                                        const interactions::Interface& interface) {
  constexpr std::uint8_t translations = 7;
  const NodeSet touching = contact_nodes(interface);
  std::vector<std::string> warnings;
  for (const ResolvedProbe& probe : probes) {
    if (probe.snap_distance > std::min(far_snap * probe.element_size, far_place)) {
      warnings.push_back(sentence(
          "probe {}: its node is {:.3g} m away from the point asked for, where elements measure "
          "{:.3g} m; give the place of a node, or refine the mesh",
          {probe.name, probe.snap_distance, probe.element_size}));
    }
    const GlobalMesh& mesh = meshes[probe.structure];
    const std::size_t clamped = std::ranges::count_if(probe.nodes, [&](GlobalIndex node) {
      return (mesh.free_components[node] & translations) == 0;
    });
    if (clamped > 0) {
      warnings.push_back(subject(probe, clamped) +
                         (mesh.supported.empty()
                              ? " clamped: the ground's own motion is recorded there"
                              : " clamped: the motion of its support is recorded there"));
    }
    const std::size_t in_contact = std::ranges::count_if(probe.nodes, [&](GlobalIndex node) {
      return touching.contains({probe.structure, node});
    });
    if (share * in_contact >= probe.nodes.size()) {
      warnings.push_back(subject(probe, in_contact) +
                         " part of a contact: the accelerations hold the impulses that act on it, "
                         "and the samples go with 1/output_interval; for a floor take nodes "
                         "one element away");
    }
  }
  return warnings;
}

}  // namespace pounding
