#include "mesh/unused_elements.h"

#include <algorithm>
#include <map>
#include <span>

#include "common/integer_sets.h"
#include "elements/element_traits.h"

namespace pounding {
namespace {

/// Tags of the nodes of a line or a surface, sorted; -1 where there are fewer than four.
using Key = std::array<std::int64_t, 4>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const std::int64_t tag : key) {
      hash = (hash ^ static_cast<std::uint64_t>(tag)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

Key key_of(std::span<const std::int64_t> nodes) {
  Key key{-1, -1, -1, -1};
  std::ranges::copy(nodes, key.begin());
  std::ranges::sort(key);
  return key;
}

class Search {
 public:
  using Taken = std::set<std::pair<std::string, int>>;

  Search(const RawMesh& raw, const GlobalMesh& mesh, const Taken& taken)
      : raw_(raw), mesh_(mesh), taken_(taken) {
    for (const ElementSet& set : mesh.regions) {
      if (!set.share.empty()) continue;  // these are nodes
      for (const std::int64_t tag : set.tags) in_use_.insert(tag);
    }
    for (const RawType& type : raw.types) types_[type.type] = &type;
  }

  std::vector<UnusedElements> run() {
    std::set<std::pair<int, int>> grouped;
    for (const RawGroup& group : raw_.groups) {
      for (const int entity : group.entities) {
        grouped.insert({group.dimension, entity});
        owners_[{group.dimension, entity}].push_back(&group);
      }
    }
    for (const RawEntity& entity : raw_.entities) {
      if (entity.dimension == 0) continue;
      if (!grouped.contains({entity.dimension, entity.tag})) {
        if (!entity.bounds_another) add(entity, "");
        continue;
      }
      for (const RawGroup* group : owners_[{entity.dimension, entity.tag}]) {
        if (!taken_.contains({group->name, group->dimension})) add(entity, group->name);
      }
    }
    mark_places();
    return collect();
  }

 private:
  struct Candidate {
    std::string group;
    int type = 0;
    std::int64_t first_node = 0;  ///< its tag
    std::int64_t last_node = 0;
    bool place = false;
  };

  void add(const RawEntity& entity, const std::string& group) {
    for (const RawElements& elements : entity.elements) {
      const std::size_t width = types_.at(elements.type)->nodes;
      for (std::size_t e = 0; e < elements.tags.size(); ++e) {
        const std::span<const std::int64_t> nodes(&elements.nodes[e * width], width);
        const bool used = in_use_.contains(elements.tags[e]);
        if (!used && entity.dimension < 3 && width <= 4) {
          by_key_.emplace(key_of(nodes), candidates_.size());
        }
        candidates_.push_back({group, elements.type, nodes.front(), nodes.back(), used});
      }
    }
  }

  /// Candidates with the nodes of an element's face, edge, or of the element itself.
  void mark(const ElementSet& set, std::size_t element, std::span<const std::size_t> corners) {
    const auto of_element = set.nodes_of(element);
    std::array<std::int64_t, 4> nodes{};
    for (std::size_t a = 0; a < corners.size(); ++a) {
      nodes[a] = mesh_.node_tags[of_element[corners[a]]];
    }
    const auto [first, last] = by_key_.equal_range(key_of({nodes.data(), corners.size()}));
    for (auto it = first; it != last; ++it) candidates_[it->second].place = true;
  }

  void mark_places() {
    if (by_key_.empty()) return;
    constexpr std::array<std::size_t, 4> all{0, 1, 2, 3};
    for (const ElementSet& set : mesh_.regions) {
      const std::size_t width = element_layout(set.type).nodes;
      for (std::size_t e = 0; e < set.tags.size(); ++e) {
        for (const ElementFace& face : traits_of(set.type).faces) mark(set, e, face.corners());
        if (is_solid(set.type)) continue;
        mark(set, e, {all.data(), width});
        for (std::size_t a = 0; is_shell(set.type) && a < width; ++a) {
          mark(set, e, std::array{a, (a + 1) % width});
        }
      }
    }
  }

  std::vector<UnusedElements> collect() const {
    std::map<std::pair<std::string, int>, UnusedElements> found;
    std::map<std::pair<std::string, int>, std::pair<std::int64_t, std::int64_t>> ends;
    for (const Candidate& candidate : candidates_) {
      const std::pair<std::string, int> name{candidate.group, candidate.type};
      UnusedElements& unused = found[name];
      const bool first = unused.count++ == 0;
      const bool first_left_out = !candidate.place && unused.left_out++ == 0;
      if (first || first_left_out) ends[name] = {candidate.first_node, candidate.last_node};
    }
    std::vector<UnusedElements> list;
    for (auto& [name, unused] : found) {
      unused.group = name.first;
      unused.kind = types_.at(name.second)->name;
      unused.place = between(ends.at(name));
      list.push_back(unused);
    }
    return list;
  }

  Vector3 between(const std::pair<std::int64_t, std::int64_t>& nodes) const {
    Vector3 place{0, 0, 0};
    for (std::size_t i = 0; i < raw_.node_tags.size(); ++i) {
      for (const std::int64_t node : {nodes.first, nodes.second}) {
        for (std::size_t d = 0; d < 3 && node == raw_.node_tags[i]; ++d) {
          place[d] += 0.5 * raw_.coordinates[3 * i + d];
        }
      }
    }
    return place;
  }

  const RawMesh& raw_;
  const GlobalMesh& mesh_;
  const Taken& taken_;
  NumberSet in_use_;  ///< element tags
  std::map<int, const RawType*> types_;
  std::map<std::pair<int, int>, std::vector<const RawGroup*>> owners_;
  std::vector<Candidate> candidates_;
  std::unordered_multimap<Key, std::size_t, KeyHash> by_key_;
};

}  // namespace

std::vector<UnusedElements> find_unused(const RawMesh& raw, const GlobalMesh& mesh,
                                        const std::set<std::pair<std::string, int>>& taken) {
  return Search(raw, mesh, taken).run();
}

}  // namespace pounding
