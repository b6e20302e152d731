#include "driver/mesh_labels.h"

#include <algorithm>

namespace pounding {

MeshLabels mesh_labels(const Scene& scene, const interactions::Interface& interface) {
  MeshLabels labels;
  for (const Structure& structure : scene.structures) {
    labels.first.push_back(labels.groups.size());
    for (const Region& region : structure.regions) {
      labels.groups.push_back(structure.name + ":" + region.group);
    }
  }
  for (const Contact& contact : scene.contacts) labels.contacts.push_back(contact.name);
  labels.contact_nodes.assign(scene.structures.size(),
                              std::vector<std::vector<GlobalIndex>>(scene.contacts.size()));
  for (const interactions::Constraint& row : interface.constraints) {
    for (const interactions::ConstraintTerm& term : row.terms) {
      labels.contact_nodes[term.structure][row.contact].push_back(term.node);
    }
  }
  for (auto& contacts : labels.contact_nodes) {
    for (std::vector<GlobalIndex>& nodes : contacts) {
      std::ranges::sort(nodes);
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
  }
  return labels;
}

}  // namespace pounding
