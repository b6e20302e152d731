#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace pounding {

/// Disjoint sets of the numbers 0 to count - 1, as trees that are flattened on the way
/// (union-find). A set is named by its smallest member.
class DisjointSets {
 public:
  /// Every number is a set of its own.
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// Smallest member of the set of `i`.
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  /// Makes one set of those of `a` and `b`.
  void join(std::size_t a, std::size_t b) {
    const std::size_t first = root(a);
    const std::size_t second = root(b);
    parent_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace pounding
