#include "mesh/order_bearings.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <map>

#include "common/error.h"
#include "common/integer_sets.h"
#include "mesh/connectivity.h"

namespace pounding {
namespace {

bool is_joint(const ElementSet& set) {
  return is_spring(set.type) && joins_two_nodes(set.type);
}

/// Number of springs, one after the other, between a node and the ground: parts of a structure
/// that hang together without springs have one number.
class Storeys {
 public:
  explicit Storeys(const GlobalMesh& mesh) : parts_(mesh.node_tags.size()) {
    join_parts(mesh);
    count(mesh);
  }

  /// None where nothing leads to the ground.
  int of(GlobalIndex node) {
    const auto found = storey_.find(part(node));
    return found == storey_.end() ? none : found->second;
  }

  static constexpr int none = std::numeric_limits<int>::max();

 private:
  std::size_t part(GlobalIndex node) { return parts_.root(static_cast<std::size_t>(node)); }
  void join(GlobalIndex a, GlobalIndex b) {
    parts_.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }

  void join_parts(const GlobalMesh& mesh) {
    for (const ElementSet& set : mesh.regions) {
      if (set.tags.empty() || is_joint(set)) continue;
      const std::size_t width = set.connectivity.size() / set.tags.size();
      for (std::size_t i = 0; i < set.connectivity.size(); ++i) {
        join(set.connectivity[i], set.connectivity[i - i % width]);
      }
    }
    for (const RigidNodes& rigid : mesh.rigid) {
      for (const GlobalIndex node : rigid.nodes) join(node, rigid.nodes.front());
    }
  }

  void count(const GlobalMesh& mesh) {
    std::map<std::size_t, std::vector<std::size_t>> beside;  // parts that a spring joins
    for (const ElementSet& set : mesh.regions) {
      if (!is_joint(set)) continue;
      for (std::size_t e = 0; e < set.tags.size(); ++e) {
        const std::size_t a = part(set.connectivity[2 * e]);
        const std::size_t b = part(set.connectivity[2 * e + 1]);
        beside[a].push_back(b);
        beside[b].push_back(a);
      }
    }
    std::deque<std::size_t> next;
    const auto reach = [&](std::size_t of, int storey) {
      if (storey_.try_emplace(of, storey).second) next.push_back(of);
    };
    for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
      const auto n = static_cast<std::size_t>(node);
      if (mesh.components[n] != mesh.free_components[n]) reach(part(node), 0);
    }
    for (const ElementSet& set : mesh.regions) {
      if (!is_grounded(set.type)) continue;
      for (const GlobalIndex node : set.connectivity) reach(part(node), 0);
    }
    for (const AbsorbingNode& absorbing : mesh.absorbing) reach(part(absorbing.node), 0);
    while (!next.empty()) {
      const std::size_t here = next.front();
      next.pop_front();
      for (const std::size_t there : beside[here]) reach(there, storey_.at(here) + 1);
    }
  }

  DisjointSets parts_;
  std::map<std::size_t, int> storey_;  ///< by part
};

[[noreturn]] void refuse_level(const Structure& structure, const Region& region, const Vector3& x,
                               std::size_t across) {
  const std::string axis(1, "xyz"[across]);
  throw UserError("structure " + structure.name + ": the two nodes of a bearing of group '" +
                  region.group + "' that slides lie at one level, at " + place_text(x) +
                  ", and as far from the ground as each other: the carried one is not known; "
                  "in the mesh move the carried node by a millimetre against gravity (without "
                  "gravity along " +
                  axis + ", towards greater " + axis + ")");
}

}  // namespace

void order_sliding_bearings(const Structure& structure, GlobalMesh& mesh) {
  const auto slides = [&](const ElementSet& set) {
    return is_joint(set) &&
           structure.regions[static_cast<std::size_t>(set.region)].nonlinear.friction > 0;
  };
  if (std::ranges::none_of(mesh.regions, slides)) return;
  const double level = coincidence * bounding_box({&mesh, 1}).diagonal();
  Storeys storeys(mesh);
  for (ElementSet& set : mesh.regions) {
    if (!slides(set)) continue;
    const Region& region = structure.regions[static_cast<std::size_t>(set.region)];
    const auto across = static_cast<std::size_t>(region.nonlinear.circle[2]);
    const double up = structure.gravity[across] > 0 ? -1 : 1;
    Places on_heads;
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      GlobalIndex& below = set.connectivity[2 * e];
      GlobalIndex& above = set.connectivity[2 * e + 1];
      const double rise = up * (mesh.position(above)[across] - mesh.position(below)[across]);
      const bool apart = rise > level || rise < -level;
      const int first = storeys.of(below);
      const int second = storeys.of(above);
      if (!apart && first == second) refuse_level(structure, region, mesh.position(below), across);
      if (apart ? rise < 0 : first > second) std::swap(below, above);
      const bool hangs = storeys.of(above) < storeys.of(below);
      if (hangs && structure.gravity[across] != 0) on_heads.add(mesh.position(above));
    }
    if (on_heads.count == 0) continue;
    mesh.doubts.push_back(
        "structure " + structure.name + ", group " + region.group + ": " +
        std::to_string(on_heads.count) + " of its bearings that slide, the first at " +
        place_text(on_heads.first) +
        ", have the nodes held by the ground above and the hanging ones below: nothing presses on "
        "them, so that they hold nothing; are they upside down?");
  }
}

}  // namespace pounding
