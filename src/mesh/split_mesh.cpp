#include "mesh/split_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "elements/element_traits.h"

namespace pounding {
namespace {

/// Nodes of a child, each by the corners of its parent that it is in the middle of, a bit each.
using Child = std::vector<unsigned>;

/// Children of a Gmsh type, in the parent's orientation and with its first edge along theirs; empty
/// for a type that is not split. Corners 0, 1, ... in Gmsh's order.
std::vector<Child> children_of(int type) {
  constexpr unsigned a = 1, b = 2, c = 4, d = 8;
  const std::vector<Child> triangles{
      {a, a | b, a | c}, {a | b, b, b | c}, {a | c, b | c, c}, {b | c, a | c, a | b}};
  const std::vector<Child> quadrangles{{a, a | b, a | b | c | d, a | d},
                                       {a | b, b, b | c, a | b | c | d},
                                       {a | b | c | d, b | c, c, c | d},
                                       {a | d, a | b | c | d, c | d, d}};
  // Wedges and hexahedra: two layers of those of their base.
  const auto layers = [](const std::vector<Child>& base, unsigned up) {
    std::vector<Child> children;
    for (const int layer : {0, 1}) {
      for (const Child& flat : base) {
        Child& child = children.emplace_back();
        for (const int level : {layer, layer + 1}) {
          for (const unsigned node : flat) {
            child.push_back((level < 2 ? node : 0) | (level > 0 ? node << up : 0));
          }
        }
      }
    }
    return children;
  };
  switch (type) {
    case 1:
      return {{a, a | b}, {a | b, b}};
    case 2:
      return triangles;
    case 3:
      return quadrangles;
    case 4:  // the octahedron in the middle is parted by its diagonal from ac to bd
      return {{a, a | b, a | c, a | d},     {a | b, b, b | c, b | d},
              {a | c, b | c, c, c | d},     {a | d, b | d, c | d, d},
              {a | b, a | c, a | d, b | d}, {a | b, b | c, a | c, b | d},
              {a | c, a | d, b | d, c | d}, {a | c, b | d, b | c, c | d}};
    case 5:
      return layers(quadrangles, 4);
    case 6:
      return layers(triangles, 3);
    default:
      return {};
  }
}

class MeshSplitter {
 public:
  MeshSplitter(const Structure& structure, RawMesh& mesh) : structure_(structure), mesh_(mesh) {
    for (std::size_t i = 0; i < mesh_.node_tags.size(); ++i) {
      places_[mesh_.node_tags[i]] = i;
      last_node_ = std::max(last_node_, mesh_.node_tags[i]);
    }
    for (const RawEntity& entity : mesh_.entities) {
      last_entity_ = std::max(last_entity_, entity.tag);
      for (const RawElements& part : entity.elements) {
        for (const std::int64_t tag : part.tags) last_element_ = std::max(last_element_, tag);
      }
    }
  }

  void split() {
    for (RawEntity& entity : mesh_.entities) {
      if (stays_whole(entity)) continue;
      for (RawElements& part : entity.elements) split(part);
    }
    for (RawGroup& group : mesh_.groups) {
      if (group.dimension == 0 && !is_region(group.name)) follow(group);
    }
  }

 private:
  /// Corners of a cell in whose middle a node is, increasing, then zeros.
  using Parents = std::array<std::int64_t, 8>;

  bool is_region(const std::string& group) const {
    return std::ranges::find(structure_.regions, group, &Region::group) != structure_.regions.end();
  }

  bool stays_whole(const RawEntity& entity) const {
    const auto holds = [&](const RawGroup& group) {
      const auto region = std::ranges::find(structure_.regions, group.name, &Region::group);
      return group.dimension == 1 && region != structure_.regions.end() &&
             region->spread == Spread::none && !is_beam(region->element) &&
             std::ranges::find(group.entities, entity.tag) != group.entities.end();
    };
    return entity.dimension == 1 && std::ranges::any_of(mesh_.groups, holds);
  }

  void split(RawElements& part) {
    const std::vector<Child> children = children_of(part.type);
    if (children.empty() || part.tags.empty()) return;
    const std::size_t width = part.nodes.size() / part.tags.size();
    RawElements cut;
    cut.type = part.type;
    for (std::size_t e = 0; e < part.tags.size(); ++e) {
      for (std::size_t i = 0; i < children.size(); ++i) {
        cut.tags.push_back(i == 0 ? part.tags[e] : ++last_element_);
        for (const unsigned corners : children[i]) {
          cut.nodes.push_back(node_between(&part.nodes[e * width], corners));
        }
      }
    }
    part = std::move(cut);
  }

  std::int64_t node_between(const std::int64_t* cell, unsigned corners) {
    Parents parents{};
    std::size_t count = 0;
    for (std::size_t i = 0; corners >> i != 0; ++i) {
      if ((corners >> i & 1) != 0) parents[count++] = cell[i];
    }
    if (count == 1) return parents[0];
    std::sort(parents.begin(), parents.begin() + static_cast<std::ptrdiff_t>(count));
    const auto [place, is_new] = nodes_.emplace(parents, last_node_ + 1);
    if (is_new) add_node(parents, count);
    return place->second;
  }

  void add_node(const Parents& parents, std::size_t count) {
    std::array<double, 3> middle{};
    for (std::size_t i = 0; i < count; ++i) {
      const double* x = &mesh_.coordinates[3 * places_.at(parents[i])];
      for (std::size_t d = 0; d < 3; ++d) middle[d] += x[d] / static_cast<double>(count);
    }
    mesh_.node_tags.push_back(++last_node_);
    mesh_.coordinates.insert(mesh_.coordinates.end(), middle.begin(), middle.end());
  }

  /// Points for the new nodes whose parents are all points of the group.
  void follow(RawGroup& group) {
    std::set<std::int64_t> points;
    for (const RawEntity& entity : mesh_.entities) {
      if (entity.dimension != 0 || std::ranges::count(group.entities, entity.tag) == 0) continue;
      for (const RawElements& part : entity.elements) {
        points.insert(part.nodes.begin(), part.nodes.end());
      }
    }
    if (points.size() < 2) return;
    RawElements added;
    added.type = traits_of(ElementType::point_mass).gmsh_type;
    for (const auto& [parents, node] : nodes_) {
      const auto is_in = [&](std::int64_t tag) { return tag == 0 || points.contains(tag); };
      if (!std::ranges::all_of(parents, is_in)) continue;
      added.tags.push_back(++last_element_);
      added.nodes.push_back(node);
    }
    if (added.tags.empty()) return;
    mesh_.entities.push_back({0, ++last_entity_, true, {std::move(added)}});
    group.entities.push_back(last_entity_);
  }

  const Structure& structure_;
  RawMesh& mesh_;
  std::map<std::int64_t, std::size_t> places_;  ///< of the nodes of the file, by tag
  std::map<Parents, std::int64_t> nodes_;       ///< new ones
  std::int64_t last_node_ = 0;
  std::int64_t last_element_ = 0;
  int last_entity_ = 0;
};

}  // namespace

void split_mesh(const Structure& structure, RawMesh& mesh) {
  MeshSplitter(structure, mesh).split();
}

}  // namespace pounding
