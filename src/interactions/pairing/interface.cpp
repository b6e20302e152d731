#include "interactions/pairing/interface.h"

#include <algorithm>

#include "common/parallel.h"

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

void broadcast_interface(MPI_Comm comm, Interface& interface) {
  std::vector<ConstraintTerm> terms;
  struct Head {
    int contact;
    int terms;
    int matched;
    double initial_gap;
    double geometric_gap;
    double facet_size;
    std::array<double, 2> place;
    double friction;
    FillerPart filler;
  };
  std::vector<Head> heads;
  for (const Constraint& c : interface.constraints) {
    heads.push_back({c.contact, static_cast<int>(c.terms.size()), c.matched ? 1 : 0, c.initial_gap,
                     c.geometric_gap, c.facet_size, c.place, c.friction, c.filler});
    terms.insert(terms.end(), c.terms.begin(), c.terms.end());
  }
  broadcast_array(comm, heads);
  broadcast_array(comm, terms);
  broadcast_sliding_faces(comm, interface.sliding);
  MPI_Bcast(&interface.model_size, 1, MPI_DOUBLE, 0, comm);
  if (rank_of(comm) == 0) return;
  auto next = terms.begin();
  interface.constraints.clear();
  for (const Head& head : heads) {
    interface.constraints.push_back({head.contact,
                                     {next, next + head.terms},
                                     head.initial_gap,
                                     head.geometric_gap,
                                     head.facet_size,
                                     head.place,
                                     head.matched != 0,
                                     head.friction,
                                     head.filler});
    next += head.terms;
  }
}

}  // namespace pounding::interactions
