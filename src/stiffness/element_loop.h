#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "elements/element_traits.h"
#include "mesh/mesh.h"

/// Place and dofs of an element, which every sweep over a mesh asks first.
namespace pounding::stiffness {

/// One element's matrices in arrays reused from element to element.
struct ElementWork {
  std::array<double, 3 * max_element_nodes> coordinates{};
  std::array<double, max_element_size * max_element_size> stiffness{};
  std::array<double, max_element_size> mass{};
};

/// Coordinates of an element's nodes, shape (nodes, 3) [m], held by `work`.
inline std::span<const double> gather_coordinates(const Mesh& mesh, const ElementBlock& block,
                                                  std::size_t element, ElementWork& work) {
  const std::size_t nodes = element_layout(block.type).nodes;
  for (std::size_t a = 0; a < nodes; ++a) {
    const Vector3 x = mesh.position(block.connectivity[element * nodes + a]);
    std::copy(x.begin(), x.end(), &work.coordinates[3 * a]);
  }
  return {work.coordinates.data(), 3 * nodes};
}

/// Local dofs of an element, component by component of each node; -1 where there is none.
class ElementDofs {
 public:
  ElementDofs(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
    const ElementLayout layout = element_layout(block.type);
    const LocalIndex* const nodes =
        &block.connectivity[element * static_cast<std::size_t>(layout.nodes)];
    for (int a = 0; a < layout.nodes; ++a) {
      for (int c = 0; c < layout.components; ++c) dofs_[size_++] = mesh.dof(nodes[a], c);
    }
  }
  std::size_t size() const { return size_; }
  const LocalIndex* begin() const { return dofs_.data(); }
  const LocalIndex* end() const { return begin() + size_; }
  LocalIndex operator[](std::size_t i) const { return dofs_[i]; }

 private:
  std::size_t size_ = 0;
  std::array<LocalIndex, max_element_size> dofs_{};
};

}  // namespace pounding::stiffness
