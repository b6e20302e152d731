#include "fuzz/mutator.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace pounding::fuzz {
namespace {

/// Larger files teach nothing more and cost time.
constexpr std::size_t largest = 1 << 16;

/// First and last place (exclusive) of a run of characters that may belong to a number, at or after
/// `from`; both the size of the text if there is none.
std::pair<std::size_t, std::size_t> number_at(const std::string& text, std::size_t from) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto part = [&](char c) {
    return digit(c) || std::string("+-.eE").find(c) != std::string::npos;
  };
  std::size_t first = from;
  while (first < text.size() && !digit(text[first])) {
    ++first;
  }
  while (first > 0 && first < text.size() && part(text[first - 1])) {
    --first;
  }
  std::size_t last = first;
  while (last < text.size() && part(text[last])) {
    ++last;
  }
  return {first, last};
}

/// First and last place (exclusive, behind its end) of the line around a place.
std::pair<std::size_t, std::size_t> line_at(const std::string& text, std::size_t place) {
  const std::size_t before = place == 0 ? std::string::npos : text.rfind('\n', place - 1);
  const std::size_t end = text.find('\n', place);
  return {before == std::string::npos ? 0 : before + 1,
          end == std::string::npos ? text.size() : end + 1};
}

void change_bytes(std::string& text, Random& random) {
  const std::size_t place = random.below(text.size());
  const std::size_t length = std::min(1 + random.below(16), text.size() - place);
  switch (random.below(5)) {
    case 0:
      text[place] = static_cast<char>(text[place] ^ (1 << random.below(8)));
      break;
    case 1:
      std::generate_n(text.begin() + static_cast<std::ptrdiff_t>(place), length,
                      [&] { return static_cast<char>(random.below(256)); });
      break;
    case 2:
      text.erase(place, length);
      break;
    case 3:
      text.insert(place, text.substr(place, length));
      break;
    default:
      text.insert(place, 1, static_cast<char>(random.below(256)));
      break;
  }
}

void change_lines(std::string& text, Random& random) {
  const auto [first, last] = line_at(text, random.below(text.size()));
  const std::string line = text.substr(first, last - first);
  switch (random.below(3)) {
    case 0:
      text.erase(first, last - first);
      break;
    case 1:
      text.insert(first, line);
      break;
    default:
      text.erase(first, last - first);
      text.insert(line_at(text, random.below(text.size())).first, line);
      break;
  }
}

}  // namespace

const std::vector<std::string>& extreme_numbers() {
  static const std::vector<std::string> numbers{"0",
                                                "-0",
                                                "-1",
                                                "1",
                                                "2147483647",
                                                "2147483648",
                                                "-2147483648",
                                                "1e308",
                                                "1e309",
                                                "-1e308",
                                                "1e-308",
                                                "1e-320",
                                                "9223372036854775807",
                                                "4294967296",
                                                "nan",
                                                "inf",
                                                "-inf",
                                                "NaN",
                                                "1e300",
                                                "-1e300",
                                                "1e-300",
                                                "0x10",
                                                "1e9",
                                                "1000000000",
                                                "1.5",
                                                "1,5",
                                                "",
                                                "--1",
                                                "1e",
                                                "1.2.3",
                                                "+",
                                                "99999999999999999999"};
  return numbers;
}

std::string mutated(std::string content, const std::string& other,
                    const std::vector<std::string>& words, Random& random) {
  for (std::size_t times = 1 + (random.chance(2) ? 0 : random.below(8)); times-- > 0;) {
    const std::size_t place = random.below(content.size());
    switch (content.empty() ? 3 : random.below(8)) {
      case 0:
      case 1:
        change_bytes(content, random);
        break;
      case 2:
        change_lines(content, random);
        break;
      case 3: {
        const std::size_t from = random.below(other.size());
        content.insert(place, other.substr(from, random.below(200)));
        break;
      }
      case 4:
        content.insert(place, words.empty() ? std::string("\n") : random.one_of(words));
        break;
      case 5:
        if (random.chance(4)) {
          content.resize(place);
        }
        break;
      default: {
        const auto [first, last] = number_at(content, place);
        content.replace(first, last - first, random.one_of(extreme_numbers()));
        break;
      }
    }
  }
  content.resize(std::min(content.size(), largest));
  return content;
}

}  // namespace pounding::fuzz
