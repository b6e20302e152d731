#include "interactions/pairing/shell_orientation.h"

#include <algorithm>
#include <utility>

namespace pounding::interactions {
namespace {

/// A facet at an edge; `forward`: it runs along the edge from the lower to the higher node.
struct FacetAtEdge {
  std::size_t facet = 0;
  bool forward = false;
};

using Edge = std::pair<GlobalIndex, GlobalIndex>;

Edge edge_of(const Facet& facet, std::size_t side) {
  const auto corners = facet.corners();
  return {corners[side], corners[(side + 1) % corners.size()]};
}

Edge sorted(const Edge& edge) {
  return {std::min(edge.first, edge.second), std::max(edge.first, edge.second)};
}

}  // namespace

std::vector<char> reversed_shells(std::span<const Facet> facets, std::span<const char> shells) {
  std::map<Edge, std::vector<FacetAtEdge>> facets_at;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t side = 0; shells[f] != 0 && side < facets[f].corners().size(); ++side) {
      const Edge edge = edge_of(facets[f], side);
      facets_at[sorted(edge)].push_back({f, edge.first < edge.second});
    }
  }
  std::vector<char> reversed(facets.size(), 0);
  std::vector<char> seen(facets.size(), 0);
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < facets.size(); ++first) {
    if (shells[first] == 0 || seen[first] != 0) continue;
    seen[first] = 1;
    queue.assign(1, first);
    while (!queue.empty()) {
      const std::size_t f = queue.back();
      queue.pop_back();
      for (std::size_t side = 0; side < facets[f].corners().size(); ++side) {
        const Edge edge = edge_of(facets[f], side);
        const std::vector<FacetAtEdge>& there = facets_at.at(sorted(edge));
        for (const FacetAtEdge& other : there) {
          if (there.size() != 2 || seen[other.facet] != 0) continue;
          // Neighbours of one orientation run along their common edge in opposite directions.
          const bool forward = (edge.first < edge.second) != (reversed[f] != 0);
          reversed[other.facet] = other.forward == forward ? 1 : 0;
          seen[other.facet] = 1;
          queue.push_back(other.facet);
        }
      }
    }
  }
  return reversed;
}

}  // namespace pounding::interactions
