#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::testing_support {

/// A structure of plates and beams that share the nodes at which they meet. Every group is a region
/// of its own, of concrete.
class FrameMesh {
 public:
  FrameMesh() { structure_.name = "frame"; }

  /// A plate of cells[0] x cells[1] quadrangles between two edges that start at `origin`.
  void add_plate(const Vector3& origin, const Vector3& first, const Vector3& second,
                 std::array<int, 2> cells, double thickness) {
    Region region = new_region(ElementType::shell4);
    region.thickness = thickness;
    ElementSet& set = new_set(region);
    const auto at = [&](int i, int j) {
      Vector3 x = origin;
      for (std::size_t d = 0; d < 3; ++d)
        x[d] += first[d] * i / cells[0] + second[d] * j / cells[1];
      return node(x);
    };
    for (int i = 0; i < cells[0]; ++i)
      for (int j = 0; j < cells[1]; ++j)
        add_element(set, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }

  /// `count` equal beams from one point to another.
  void add_beams(const Vector3& from, const Vector3& to, int count, const Vector3& z_axis) {
    Region region = new_region(ElementType::beam);
    region.section = Section{"steel", 34e-4, 864e-8, 318e-8, 14e-8, z_axis, 21e-4, 8e-4};
    ElementSet& set = new_set(region);
    const auto at = [&](int i) {
      Vector3 x{};
      for (std::size_t d = 0; d < 3; ++d) x[d] = from[d] + (to[d] - from[d]) * i / count;
      return node(x);
    };
    for (int i = 0; i < count; ++i) add_element(set, {at(i), at(i + 1)});
  }

  GlobalMesh& mesh() { return mesh_; }
  const Structure& structure() const { return structure_; }

  void clamp(const Vector3& x) { mesh_.free_components[static_cast<std::size_t>(node(x))] = 0; }

 private:
  Region new_region(ElementType type) {
    Region region;
    region.group = "group" + std::to_string(structure_.regions.size());
    region.element = type;
    region.material = {"concrete", 30e9, 0.2, 2400};
    return region;
  }

  ElementSet& new_set(const Region& region) {
    ElementSet set;
    set.group = region.group;
    set.region = static_cast<int>(structure_.regions.size());
    set.type = region.element;
    structure_.regions.push_back(region);
    mesh_.regions.push_back(set);
    return mesh_.regions.back();
  }

  /// The node at a point, which may have to be made.
  GlobalIndex node(const Vector3& x) {
    std::array<long, 3> key{};
    for (std::size_t d = 0; d < 3; ++d) key[d] = std::lround(1e6 * x[d]);
    const auto [found, fresh] = nodes_.try_emplace(key, mesh_.node_count());
    if (fresh) {
      mesh_.node_tags.push_back(mesh_.node_count() + 1);
      mesh_.coordinates.insert(mesh_.coordinates.end(), x.begin(), x.end());
      mesh_.components.push_back(0x3f);
      mesh_.free_components.push_back(0x3f);
    }
    return found->second;
  }

  void add_element(ElementSet& set, std::vector<GlobalIndex> corners) {
    set.tags.push_back(++elements_);
    set.connectivity.insert(set.connectivity.end(), corners.begin(), corners.end());
  }

  GlobalMesh mesh_;
  Structure structure_;
  std::map<std::array<long, 3>, GlobalIndex> nodes_;
  std::int64_t elements_ = 0;
};

}  // namespace pounding::testing_support
