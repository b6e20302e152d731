#include "mesh/element_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "common/error.h"
#include "common/facts.h"
#include "elements/element_traits.h"

namespace pounding {
namespace {

struct HashedElement {
  std::uint64_t hash = 0;  ///< of the nodes in increasing order
  const ElementSet* set = nullptr;
  std::size_t element = 0;
};

std::vector<GlobalIndex> sorted_nodes(const ElementSet& set, std::size_t element) {
  const auto found = set.nodes_of(element);
  std::vector<GlobalIndex> nodes(found.begin(), found.end());
  std::ranges::sort(nodes);
  return nodes;
}

std::uint64_t hash_of(const std::vector<GlobalIndex>& nodes) {
  std::uint64_t hash = 0;
  for (const GlobalIndex node : nodes) {
    hash = (hash ^ static_cast<std::uint64_t>(node)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

/// Refuses two elements of some sets on the same nodes.
void check(const std::string& structure, std::span<const ElementSet* const> sets) {
  std::size_t count = 0;
  for (const ElementSet* set : sets) count += set->tags.size();
  std::vector<HashedElement> entries;
  entries.reserve(count);
  for (const ElementSet* set : sets) {
    for (std::size_t e = 0; e < set->tags.size(); ++e) {
      entries.push_back({hash_of(sorted_nodes(*set, e)), set, e});
    }
  }
  std::ranges::stable_sort(entries, {}, &HashedElement::hash);
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const HashedElement& one = entries[i - 1];
    const HashedElement& other = entries[i];
    if (one.hash == other.hash &&
        sorted_nodes(*one.set, one.element) == sorted_nodes(*other.set, other.element)) {
      throw UserError("structure " + structure + ": element " +
                      std::to_string(other.set->tags[other.element]) + " of group '" +
                      other.set->group + "' lies on the nodes of element " +
                      std::to_string(one.set->tags[one.element]) + " of group '" + one.set->group +
                      "': it would count twice; remove one of them");
    }
  }
}

/// Parts of the diagonal of the mesh; a shorter line has its direction from round-off.
constexpr double smallest_edge = 1e-12;
constexpr double shortest_line = 1e-8;

/// The smallest distance between two nodes of an element [m].
double smallest_distance(const GlobalMesh& mesh, std::span<const GlobalIndex> corner) {
  double smallest = INFINITY;
  for (std::size_t a = 1; a < corner.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      smallest = std::min(smallest, distance(mesh.position(corner[a]), mesh.position(corner[b])));
    }
  }
  return smallest;
}

/// Elements of one type on an entity, each by its nodes.
class Copies {
 public:
  explicit Copies(const RawElements& elements)
      : elements_(elements), width_(elements.nodes.size() / elements.tags.size()) {
    sorted_ = elements.nodes;
    for (std::size_t e = 0; e < elements.tags.size(); ++e) {
      std::ranges::sort(std::span(sorted_).subspan(e * width_, width_));
    }
  }

  /// Elements that are not among the first `most` - 1 repetitions of another one, in their order.
  std::vector<std::size_t> kept(int most) const {
    std::vector<std::size_t> order(elements_.tags.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [this](std::size_t a, std::size_t b) {
      return std::ranges::lexicographical_compare(of(sorted_, a), of(sorted_, b));
    });
    std::vector<std::size_t> kept;
    int copies = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool again =
          i > 0 && std::ranges::equal(of(sorted_, order[i]), of(sorted_, order[i - 1]));
      copies = again ? copies + 1 : 1;
      if (copies == 1 || copies > most) kept.push_back(order[i]);
    }
    std::ranges::sort(kept);
    return kept;
  }

  RawElements only(const std::vector<std::size_t>& kept) const {
    RawElements part;
    part.type = elements_.type;
    for (const std::size_t e : kept) {
      part.tags.push_back(elements_.tags[e]);
      std::ranges::copy(of(elements_.nodes, e), std::back_inserter(part.nodes));
    }
    return part;
  }

 private:
  std::span<const std::int64_t> of(const std::vector<std::int64_t>& nodes, std::size_t e) const {
    return {&nodes[e * width_], width_};
  }

  const RawElements& elements_;
  std::size_t width_;
  std::vector<std::int64_t> sorted_;  ///< nodes of each element, in increasing order
};

}  // namespace

void drop_repeated_facets(std::vector<Facet>& facets) {
  std::vector<std::pair<std::array<GlobalIndex, 4>, std::size_t>> order;
  order.reserve(facets.size());
  for (const Facet& facet : facets) {
    std::array<GlobalIndex, 4> nodes = facet.nodes;
    std::ranges::sort(nodes);
    order.emplace_back(nodes, order.size());
  }
  std::ranges::sort(order);
  std::vector<char> repeats(facets.size(), 0);
  for (std::size_t i = 1; i < order.size(); ++i) {
    repeats[order[i].second] = order[i].first == order[i - 1].first ? 1 : 0;
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (repeats[f] == 0) facets[kept++] = facets[f];
  }
  facets.resize(kept);
}

void check_repeated_elements(const std::string& structure, const GlobalMesh& mesh) {
  std::vector<const ElementSet*> extended;
  for (const ElementSet& set : mesh.regions) {
    if (carries_faces(set.type)) {
      extended.push_back(&set);
    } else {
      check(structure, std::array{&set});
    }
  }
  check(structure, extended);
}

std::vector<std::span<const GlobalIndex>> elements_at(const GlobalMesh& mesh, GlobalIndex node) {
  std::vector<std::span<const GlobalIndex>> found;
  for (const ElementSet& set : mesh.regions) {
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      const std::span<const GlobalIndex> corners = set.nodes_of(e);
      if (std::ranges::find(corners, node) != corners.end()) found.push_back(corners);
    }
  }
  return found;
}

double element_size_at(const GlobalMesh& mesh, GlobalIndex node) {
  double largest = 0;
  for (const auto& corners : elements_at(mesh, node)) {
    for (const GlobalIndex a : corners) {
      for (const GlobalIndex b : corners) {
        largest = std::max(largest, distance(mesh.position(a), mesh.position(b)));
      }
    }
  }
  return largest;
}

void check_element_sizes(const std::string& structure, const GlobalMesh& mesh) {
  const double size = bounding_box({&mesh, 1}).diagonal();
  for (const ElementSet& set : mesh.regions) {
    const double least = size * (joins_two_nodes(set.type) ? shortest_line : smallest_edge);
    for (std::size_t e = 0; has_extent(set.type) && e < set.tags.size(); ++e) {
      const double found = smallest_distance(mesh, set.nodes_of(e));
      if (!(found > least)) {
        throw UserError(
            sentence("structure {}: element {} of group '{}': two of its nodes are {} m apart, "
                     "nothing beside the size of the mesh; mend the mesh",
                     {structure, set.tags[e], set.group, found}));
      }
    }
  }
}

void merge_shared_elements(RawMesh& mesh) {
  std::map<std::pair<int, int>, int> groups;  // by dimension and tag of an entity
  for (const RawGroup& group : mesh.groups) {
    for (const int entity : group.entities) ++groups[{group.dimension, entity}];
  }
  for (RawEntity& entity : mesh.entities) {
    const int most = groups[{entity.dimension, entity.tag}];
    if (most < 2) continue;
    for (RawElements& elements : entity.elements) {
      if (elements.tags.empty()) continue;
      const Copies copies(elements);
      const std::vector<std::size_t> kept = copies.kept(most);
      if (kept.size() < elements.tags.size()) elements = copies.only(kept);
    }
  }
}

}  // namespace pounding
