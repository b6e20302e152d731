#pragma once

#include <utility>

#include "common/error.h"
#include "elements/geometric_stiffness.h"
#include "mesh/element_properties.h"
#include "mesh/location.h"
#include "stiffness/element_loop.h"
#include "stiffness/single_stiffness.h"

namespace pounding {

/// Calls `visit(block, element, layout, work)` with the matrices of every element on this rank of
/// the blocks that `wanted(block, element)` lets pass. Throws UserError naming an element that is
/// impossible.
template <typename Wanted, typename Visit>
void for_each_element(const Structure& structure, const Mesh& mesh, Wanted&& wanted,
                      Visit&& visit) {
  stiffness::ElementWork work;
  for (const ElementBlock& block : mesh.blocks) {
    const Region& region = structure.regions[block.region];
    ElementProperties properties = element_properties(region);
    const ElementLayout layout = element_layout(block.type);
    const std::size_t size = layout.size();
    for (std::size_t e = 0; e < block.count(); ++e) {
      if (!wanted(block, e)) continue;
      if (!block.share.empty()) properties = element_properties(region, block.share[e]);
      try {
        stiffness::element_matrices_in(
            structure.numbers, block.type, gather_coordinates(mesh, block, e, work), properties,
            {work.stiffness.data(), size * size}, {work.mass.data(), size});
        if (!block.axial_force.empty()) {
          add_geometric_stiffness(block.type, gather_coordinates(mesh, block, e, work), properties,
                                  block.axial_force[e], {work.stiffness.data(), size * size});
        }
      } catch (const ElementError& error) {
        throw UserError("structure " + structure.name + ": " + describe_element(mesh, block, e) +
                        ": " + error.what());
      }
      visit(block, e, layout, work);
    }
  }
}

/// Hands the elements of one region over as for_each_element does.
template <typename Visit>
void for_each_element_of(const Structure& structure, const Mesh& mesh, int region, Visit&& visit) {
  for_each_element(
      structure, mesh,
      [region](const ElementBlock& block, std::size_t) { return block.region == region; },
      std::forward<Visit>(visit));
}

}  // namespace pounding
