#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "interactions/pairing/contact_sides.h"
#include "interactions/pairing/facet_finder.h"
#include "interactions/pairing/interface.h"
#include "interactions/pairing/sliding_faces.h"

namespace pounding::interactions {

/// Gathers the rows of one contact whose pairs are found anew: nodes of one side and the facets of
/// the other that each may come to face. Serial, rank 0.
class SlidingBuilder {
 public:
  /// References must outlive this object; `faces` is added to. `number`: index of the contact.
  /// Throws UserError where facets are edges.
  SlidingBuilder(const Contact& contact, int number, const FaceSide& nodes, const FaceSide& facets,
                 const FacetFinder& finder, SlidingFaces& faces);

  /// Some facet is within reach of node `i` of the face.
  bool may_face(std::size_t i) const;
  /// Node `i` of the face belongs to the last constraint.
  void add_row(std::size_t i, std::span<const Constraint> constraints);

 private:
  std::vector<std::size_t> within_reach(std::size_t i) const;
  int facet_number(std::size_t facet);
  int node_number(const FaceSide& side, GlobalIndex node);

  double reach_;
  int contact_;
  const FaceSide& side_;
  const FaceSide& other_;
  const FacetFinder& finder_;
  SlidingFaces& faces_;
  std::vector<int> facets_;                           ///< per facet: its number; -1: none yet
  std::map<std::pair<int, GlobalIndex>, int> nodes_;  ///< structure and node: its number
};

}  // namespace pounding::interactions
