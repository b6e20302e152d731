#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace pounding::fuzz {

/// Random numbers that are the same for the same seed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 0 to count - 1; 0 for an empty range.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : engine_() % count; }
  bool chance(std::size_t one_in) { return below(one_in) == 0; }
  template <typename Item>
  const Item& one_of(const std::vector<Item>& items) {
    return items[below(items.size())];
  }

 private:
  std::mt19937_64 engine_;
};

/// Numbers at which readers fail: 0, -1, the ends of the types, infinities, nan, in several
/// spellings.
const std::vector<std::string>& extreme_numbers();

/// A text or a binary file changed at one to eight places: bits flipped, bytes overwritten, taken
/// out, repeated or put in, the end cut off, a part of `other` spliced in, a number replaced by an
/// extreme one, lines swapped, repeated or dropped, words of `words` put in.
std::string mutated(std::string content, const std::string& other,
                    const std::vector<std::string>& words, Random& random);

}  // namespace pounding::fuzz
