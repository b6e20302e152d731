#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace pounding {

/// Leaves each value once, in increasing order.
void keep_once(auto& values) {
  std::ranges::sort(values);
  const auto rest = std::ranges::unique(values);
  values.erase(rest.begin(), rest.end());
}

/// A set of whole numbers that mostly follow each other, as the tags of a mesh do: one bit each,
/// and at most some hundred bytes where they do not.
class NumberSet {
 public:
  /// False if the number is there already.
  bool insert(std::int64_t number) {
    std::uint64_t& word = pages_[page_of(number)].words[word_of(number)];
    const bool fresh = (word & bit_of(number)) == 0;
    word |= bit_of(number);
    return fresh;
  }

  bool contains(std::int64_t number) const {
    const auto found = pages_.find(page_of(number));
    return found != pages_.end() && (found->second.words[word_of(number)] & bit_of(number)) != 0;
  }

  /// All numbers in increasing order. Counts them for `index`, which holds until the next insert.
  std::vector<std::int64_t> sort();

  /// How many numbers of the set are smaller; -1 if this one is not in it. Call `sort` before.
  std::int64_t index(std::int64_t number) const;

 private:
  static constexpr std::size_t word_count = 8;
  static constexpr std::size_t bits = 64;
  static constexpr std::int64_t page_size = word_count * bits;
  struct Page {
    std::array<std::uint64_t, word_count> words{};
    std::int64_t before = 0;  ///< numbers in smaller pages
  };

  static std::int64_t page_of(std::int64_t number) { return number >> 9; }
  static std::size_t word_of(std::int64_t number) {
    return static_cast<std::size_t>(number & (page_size - 1)) / bits;
  }
  static std::uint64_t bit_of(std::int64_t number) {
    return std::uint64_t{1} << (static_cast<std::uint64_t>(number) % bits);
  }

  std::unordered_map<std::int64_t, Page> pages_;
};

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
