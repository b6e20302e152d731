#include "common/integer_sets.h"

namespace pounding {

std::vector<std::int64_t> NumberSet::sort() {
  std::vector<std::int64_t> order;
  order.reserve(pages_.size());
  for (const auto& [page, content] : pages_) order.push_back(page);
  std::ranges::sort(order);
  std::int64_t count = 0;
  for (const std::int64_t page : order) {
    Page& content = pages_[page];
    content.before = count;
    for (const std::uint64_t word : content.words) count += std::popcount(word);
  }
  std::vector<std::int64_t> numbers;
  numbers.reserve(static_cast<std::size_t>(count));
  for (const std::int64_t page : order) {
    const Page& content = pages_[page];
    for (std::size_t w = 0; w < word_count; ++w) {
      for (std::uint64_t word = content.words[w]; word != 0; word &= word - 1) {
        numbers.push_back(page * page_size + static_cast<std::int64_t>(w * bits) +
                          std::countr_zero(word));
      }
    }
  }
  return numbers;
}

std::int64_t NumberSet::index(std::int64_t number) const {
  const auto found = pages_.find(page_of(number));
  if (found == pages_.end()) return -1;
  const Page& page = found->second;
  const std::size_t at = word_of(number);
  if ((page.words[at] & bit_of(number)) == 0) return -1;
  std::int64_t below = page.before + std::popcount(page.words[at] & (bit_of(number) - 1));
  for (std::size_t w = 0; w < at; ++w) below += std::popcount(page.words[w]);
  return below;
}

}  // namespace pounding
