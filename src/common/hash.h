#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>

namespace pounding {

/// Fowler-Noll-Vo hash (FNV-1a, 64 bits) of numbers, by their bits, and of text.
class Hash {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) {
      hash_ = (hash_ ^ (bits >> shift & 0xff)) * 0x100000001b3;
    }
  }
  void add(const std::string& text) {
    add(static_cast<double>(text.size()));
    for (const char letter : text) {
      hash_ = (hash_ ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
    }
  }
  template <typename Values>
  void add_all(const Values& values) {
    add(static_cast<double>(values.size()));
    for (const auto& value : values) add(static_cast<double>(value));
  }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace pounding
