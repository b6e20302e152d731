#include "interactions/pairing/interface.h"

#include <algorithm>

namespace pounding::interactions {

bool has_fillers(const Interface& interface) {
  return std::ranges::any_of(interface.constraints,
                             [](const Constraint& c) { return c.filler.area > 0; });
}

std::vector<NodeLink> facing_nodes(const Interface& interface) {
  std::vector<NodeLink> links;
  for (const Constraint& constraint : interface.constraints) {
    const ConstraintTerm& secondary = constraint.terms.back();
    for (const ConstraintTerm& term : constraint.terms) {
      if (term.structure != secondary.structure || term.node != secondary.node) {
        links.push_back({secondary.structure, secondary.node, term.structure, term.node});
      }
    }
  }
  return links;
}

}  // namespace pounding::interactions
