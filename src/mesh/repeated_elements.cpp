#include "mesh/repeated_elements.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "common/error.h"
#include "elements/element_traits.h"

namespace pounding {
namespace {

struct HashedElement {
  std::uint64_t hash = 0;  ///< of the nodes in increasing order
  const ElementSet* set = nullptr;
  std::size_t element = 0;
};

std::vector<GlobalIndex> sorted_nodes(const ElementSet& set, std::size_t element) {
  const std::size_t width = element_layout(set.type).nodes;
  const auto first = set.connectivity.begin() + static_cast<std::ptrdiff_t>(element * width);
  std::vector<GlobalIndex> nodes(first, first + static_cast<std::ptrdiff_t>(width));
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

}  // namespace pounding
