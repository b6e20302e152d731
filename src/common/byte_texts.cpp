#include "common/byte_texts.h"

#include <algorithm>

namespace pounding {
namespace {

/// Length of the letter of UTF-8 at the begin of a text; 0 if there is none.
std::size_t letter_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80                     ? 1
                             : first >= 0xc2 && first <= 0xdf ? 2
                             : (first & 0xf0) == 0xe0         ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const unsigned second = length > 1 ? byte(1) : 0;
  const bool is_none = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                       (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return is_none ? 0 : length;
}

/// A text with `mark` in place of each byte that is no UTF-8.
template <typename Mark>
std::string replaced(std::string_view bytes, const Mark& mark) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t length = letter_length(bytes);
    if (length == 0) {
      text += mark(static_cast<unsigned char>(bytes[0]));
    } else {
      text += bytes.substr(0, length);
    }
    bytes.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text;
}

/// The last two bytes of a letter whose lower twelve bits are these.
std::string tail(unsigned bits) {
  return {static_cast<char>(0x80 | (bits >> 6U)), static_cast<char>(0x80 | (bits & 0x3fU))};
}

}  // namespace

std::string readable(std::string_view bytes) {
  return replaced(bytes, [](unsigned byte) {
    return std::string{static_cast<char>(0xc0 | (byte >> 6U)),
                       static_cast<char>(0x80 | (byte & 0x3fU))};
  });
}

std::string with_marked_bytes(std::string_view bytes) {
  return replaced(bytes, [](unsigned byte) { return '\xef' + tail(0x700 + byte); });
}

std::string with_plain_bytes(std::string_view marked) {
  std::string bytes;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    const bool is_marked = marked.substr(i, 1) == "\xef" && i + 2 < marked.size() &&
                           (marked[i + 1] == '\x9e' || marked[i + 1] == '\x9f');
    if (!is_marked) {
      bytes += marked[i];
      continue;
    }
    bytes += static_cast<char>((static_cast<unsigned char>(marked[i + 1]) & 3U) << 6U |
                               (static_cast<unsigned char>(marked[i + 2]) & 0x3fU));
    i += 2;
  }
  return bytes;
}

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  return text;
}

}  // namespace pounding
