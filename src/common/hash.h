#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>

namespace pounding {

/// Fowler-Noll-Vo hash (FNV-1a, 64 bits) of numbers, by their bits, and of text.
class Hash {
 public:
  /// Numbers, texts, or arrays of numbers with their sizes.
  template <typename... Values>
  void add(const Values&... values) {
    (add_one(values), ...);
  }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

 private:
  void add_number(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) {
      hash_ = (hash_ ^ (bits >> shift & 0xff)) * 0x100000001b3;
    }
  }
  template <typename Value>
  void add_one(const Value& value) {
    if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
      const std::string_view text = value;
      add_number(static_cast<double>(text.size()));
      for (const char letter : text) {
        hash_ = (hash_ ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
      }
    } else if constexpr (requires { value.size(); }) {
      add_number(static_cast<double>(value.size()));
      for (const auto& part : value) add_number(static_cast<double>(part));
    } else {
      add_number(static_cast<double>(value));
    }
  }

  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace pounding
