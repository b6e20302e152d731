#include "model/element_middle.h"

#include <algorithm>

namespace pounding {

Vector3 element_middle(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
  const std::size_t nodes = block.connectivity.size() / block.count();
  Vector3 middle{};
  for (std::size_t a = 0; a < nodes; ++a) {
    const Vector3 x = mesh.position(block.connectivity[nodes * element + a]);
    for (std::size_t d = 0; d < 3; ++d) middle[d] += x[d] / static_cast<double>(nodes);
  }
  return middle;
}

Vector3 element_middle(const Mesh& mesh, const std::string& group, std::int64_t number) {
  for (const ElementBlock& block : mesh.blocks) {
    const auto found = std::ranges::find(block.tags, number);
    if (block.group != group || found == block.tags.end()) continue;
    return element_middle(mesh, block, static_cast<std::size_t>(found - block.tags.begin()));
  }
  return {};
}

}  // namespace pounding
