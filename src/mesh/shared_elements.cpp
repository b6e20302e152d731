#include "mesh/shared_elements.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace pounding {
namespace {

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
