#include "interactions/pairing/sliding_builder.h"

#include <utility>

#include "common/error.h"

namespace pounding::interactions {

SlidingBuilder::SlidingBuilder(const Contact& contact, int number, const FaceSide& nodes,
                               const FaceSide& facets, const FacetFinder& finder,
                               SlidingFaces& faces)
    : reach_(contact.sliding),
      contact_(number),
      side_(nodes),
      other_(facets),
      finder_(finder),
      faces_(faces),
      facets_(facets.face.facets.size(), -1) {
  if (facets.face.has_lines()) {
    throw UserError("option -" + contact.name +
                    "_sliding: pairs are found anew on facets of solids and shells, and a face of "
                    "this contact has edges or axes of beams; leave it out");
  }
}

std::vector<std::size_t> SlidingBuilder::within_reach(std::size_t i) const {
  return finder_.within(side_.mesh->position(side_.face.nodes[i]), side_.face.node_normals[i],
                        reach_);
}

bool SlidingBuilder::may_face(std::size_t i) const {
  return !within_reach(i).empty();
}

int SlidingBuilder::node_number(const FaceSide& side, GlobalIndex node) {
  const auto [found, fresh] =
      nodes_.try_emplace({side.structure, node}, static_cast<int>(faces_.nodes.size()));
  if (fresh) faces_.nodes.push_back({side.structure, node, side.mesh->position(node)});
  return found->second;
}

int SlidingBuilder::facet_number(std::size_t facet) {
  if (facets_[facet] >= 0) return facets_[facet];
  SlidingFaces::Facet entry;
  for (const GlobalIndex node : other_.face.facets[facet].corners()) {
    entry.nodes[static_cast<std::size_t>(entry.count++)] = node_number(other_, node);
  }
  entry.half_thickness = other_.face.facet_half_thickness[facet];
  entry.size = other_.face.facet_size(facet);
  facets_[facet] = static_cast<int>(faces_.facets.size());
  faces_.facets.push_back(entry);
  return facets_[facet];
}

void SlidingBuilder::add_row(std::size_t i, std::span<const Constraint> constraints) {
  SlidingFaces::Row row;
  row.constraint = static_cast<int>(constraints.size()) - 1;
  row.contact = contact_;
  row.node = node_number(side_, side_.face.nodes[i]);
  row.normal = side_.face.node_normals[i];
  row.half_thickness = side_.face.node_half_thickness[i];
  row.depth = side_.face.node_depth[i];
  row.first = static_cast<int>(faces_.candidates.size());
  for (const std::size_t facet : within_reach(i)) {
    faces_.candidates.push_back(facet_number(facet));
  }
  row.end = static_cast<int>(faces_.candidates.size());
  faces_.rows.push_back(row);
}

}  // namespace pounding::interactions
