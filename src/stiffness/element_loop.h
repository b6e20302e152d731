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
inline std::array<LocalIndex, max_element_size> element_dofs(const Mesh& mesh,
                                                             const ElementBlock& block,
                                                             std::size_t element,
                                                             const ElementLayout& layout) {
  std::array<LocalIndex, max_element_size> dofs{};
  for (int a = 0; a < layout.nodes; ++a) {
    const LocalIndex node = block.connectivity[element * static_cast<std::size_t>(layout.nodes) +
                                               static_cast<std::size_t>(a)];
    for (int c = 0; c < layout.components; ++c) {
      dofs[a * layout.components + c] = mesh.dof(node, c);
    }
  }
  return dofs;
}

}  // namespace pounding::stiffness
