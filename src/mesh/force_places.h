#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// An item of the option `forces` on its mesh.
struct ResolvedForce {
  int structure = 0;
  /// Elements that it is about, by their numbers in the file: of members those chosen, in the order
  /// of their points or by number; of cuts, and of totals of a reduced structure, those that pass
  /// force on to elements that are not counted; none of totals at full order.
  std::vector<std::int64_t> elements;
  std::vector<int> regions;        ///< of each of them, since a point may be several elements
  std::vector<GlobalIndex> nodes;  ///< of these elements, sorted

  static void members(auto& self, auto& stream) {
    stream(self.structure, self.elements, self.regions, self.nodes);
  }
};

/// Whether a total counts the forces on a component of a node at `x` [m]: it is free and above the
/// level, or beyond a cut.
bool counts(const ForceItem& force, std::uint8_t free_components, const Vector3& x, int component);

/// Finds the elements of every item. Throws UserError for a point far from the group's elements and
/// for a plane that misses them.
std::vector<ResolvedForce> resolve_forces(const Scene& scene, std::span<const GlobalMesh> meshes);

}  // namespace pounding
