#include "mesh/element_sizes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>

#include "common/error.h"
#include "elements/element_traits.h"
#include "mesh/bounding_box.h"

namespace pounding {
namespace {

/// Parts of the diagonal of the mesh; a shorter line has its direction from round-off.
constexpr double smallest_edge = 1e-12;
constexpr double shortest_line = 1e-8;

/// The smallest distance between two nodes of an element [m].
double smallest_distance(const GlobalMesh& mesh, const GlobalIndex* corner, std::size_t nodes) {
  double smallest = INFINITY;
  for (std::size_t a = 1; a < nodes; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      smallest = std::min(smallest, distance(mesh.position(corner[a]), mesh.position(corner[b])));
    }
  }
  return smallest;
}

}  // namespace

double element_size_at(const GlobalMesh& mesh, GlobalIndex node) {
  double largest = 0;
  for (const ElementSet& set : mesh.regions) {
    const std::size_t nodes = element_layout(set.type).nodes;
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      const std::span<const GlobalIndex> corners(&set.connectivity[e * nodes], nodes);
      if (std::ranges::find(corners, node) == corners.end()) continue;
      for (const GlobalIndex a : corners) {
        for (const GlobalIndex b : corners) {
          largest = std::max(largest, distance(mesh.position(a), mesh.position(b)));
        }
      }
    }
  }
  return largest;
}

void check_element_sizes(const std::string& structure, const GlobalMesh& mesh) {
  const double size = bounding_box({&mesh, 1}).diagonal();
  for (const ElementSet& set : mesh.regions) {
    const std::size_t nodes = element_layout(set.type).nodes;
    const double least = size * (joins_two_nodes(set.type) ? shortest_line : smallest_edge);
    for (std::size_t e = 0; has_extent(set.type) && e < set.tags.size(); ++e) {
      const double found = smallest_distance(mesh, &set.connectivity[e * nodes], nodes);
      if (!(found > least)) {
        std::ostringstream text;
        text << "structure " << structure << ": element " << set.tags[e] << " of group '"
             << set.group << "': two of its nodes are " << found
             << " m apart, nothing beside the size of the mesh; mend the mesh";
        throw UserError(text.str());
      }
    }
  }
}

}  // namespace pounding
