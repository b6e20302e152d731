#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

/// Numbers that look random and are the same for the same n, on every rank and machine.
namespace pounding {

/// A number in (0, 1) for each n (the mixer of SplitMix64).
inline double scattered(std::uint64_t n) {
  n += 0x9e3779b97f4a7c15u;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
  n ^= n >> 31;
  return (static_cast<double>(n >> 11) + 0.5) * 0x1p-53;
}

/// Normally distributed, by Box and Muller: a vector of these has no preferred direction.
inline double scattered_normal(std::uint64_t n) {
  return std::sqrt(-2 * std::log(scattered(2 * n))) *
         std::cos(2 * std::numbers::pi * scattered(2 * n + 1));
}

}  // namespace pounding
