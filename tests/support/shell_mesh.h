#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::testing_support {

/// Shells of quadrangles put together side by side: common points are common nodes.
class ShellMesh {
 public:
  /// The node at a point, made if there is none.
  GlobalIndex node(const Vector3& point) {
    for (GlobalIndex n = 0; n < mesh_.node_count(); ++n) {
      if (mesh_.position(n) == point) {
        return n;
      }
    }
    mesh_.node_tags.push_back(mesh_.node_count() + 1);
    mesh_.coordinates.insert(mesh_.coordinates.end(), point.begin(), point.end());
    return mesh_.node_count() - 1;
  }

  /// A quadrangle of a region of the structure, which is also a facet of a group unless "".
  void add_shell(int region, const std::array<Vector3, 4>& corners, const std::string& group = "") {
    ElementSet* set = nullptr;
    for (ElementSet& other : mesh_.regions) {
      set = other.region == region ? &other : set;
    }
    if (set == nullptr) {
      set = &mesh_.regions.emplace_back();
      set->region = region;
      set->type = ElementType::shell4;
    }
    set->tags.push_back(static_cast<std::int64_t>(set->tags.size()) + 1);
    for (const Vector3& corner : corners) {
      set->connectivity.push_back(node(corner));
    }
    if (!group.empty()) {
      add_facet(group, corners);
    }
  }

  /// An edge or quadrangle of a group.
  void add_facet(const std::string& group, std::span<const Vector3> corners) {
    Facet facet;
    for (const Vector3& corner : corners) {
      facet.nodes[static_cast<std::size_t>(facet.count++)] = node(corner);
    }
    std::vector<GlobalIndex>& nodes = mesh_.groups[group].nodes;
    for (const GlobalIndex n : facet.corners()) {
      if (std::ranges::find(nodes, n) == nodes.end()) {
        nodes.push_back(n);
      }
    }
    std::ranges::sort(nodes);
    mesh_.groups[group].facets.push_back(facet);
  }

  GlobalMesh mesh() {
    mesh_.components.assign(mesh_.node_tags.size(), 0x3f);
    mesh_.free_components = mesh_.components;
    return mesh_;
  }

 private:
  GlobalMesh mesh_;
};

/// A structure with a region of shells per thickness.
inline Structure shell_structure(const std::string& name, const std::vector<double>& thicknesses) {
  Structure structure;
  structure.name = name;
  for (const double thickness : thicknesses) {
    Region& region = structure.regions.emplace_back();
    region.element = ElementType::shell4;
    region.thickness = thickness;
    region.material = {"concrete", 30e9, 0.2, 2400};
  }
  return structure;
}

}  // namespace pounding::testing_support
