#include "mesh/near_nodes.h"

#include <algorithm>
#include <cmath>

#include "mesh/bounding_box.h"

namespace pounding {
namespace {

using GridCell = std::array<std::int64_t, 3>;

struct NodeInCell {
  GridCell cell;
  GlobalIndex node;
  auto operator<=>(const NodeInCell&) const = default;
};

/// The cells that a node's surroundings reach into: mostly one.
void add_cells(const Vector3& x, double side, double distance, GlobalIndex node,
               std::vector<NodeInCell>& entries) {
  // Meshes like round numbers: their planes are kept off the borders of cells.
  constexpr double offset = 0.3819660112501051;
  GridCell low{};
  GridCell high{};
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = static_cast<std::int64_t>(std::floor((x[d] - distance) / side + offset));
    high[d] = static_cast<std::int64_t>(std::floor((x[d] + distance) / side + offset));
  }
  for (std::int64_t i = low[0]; i <= high[0]; ++i) {
    for (std::int64_t j = low[1]; j <= high[1]; ++j) {
      for (std::int64_t k = low[2]; k <= high[2]; ++k) entries.push_back({{i, j, k}, node});
    }
  }
}

}  // namespace

std::vector<std::pair<GlobalIndex, GlobalIndex>> near_nodes(const GlobalMesh& mesh, double near) {
  constexpr double cell_side = 16;  // in distances
  std::vector<NodeInCell> entries;
  entries.reserve(static_cast<std::size_t>(mesh.node_count()) * 3 / 2);
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    add_cells(mesh.position(node), cell_side * near, near, node, entries);
  }
  std::ranges::sort(entries);
  std::vector<std::pair<GlobalIndex, GlobalIndex>> pairs;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size() && entries[j].cell == entries[i].cell; ++j) {
      if (distance(mesh.position(entries[i].node), mesh.position(entries[j].node)) <= near) {
        pairs.emplace_back(entries[i].node, entries[j].node);
      }
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace pounding
