#include "stiffness/rows/parity_split.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "common/array_reductions.h"

namespace pounding::stiffness {
namespace {

constexpr double largest_leak = 1e-13;

std::vector<double> corner_stiffness(ElementType type, const ElementProperties& properties,
                                     const Vector3& lengths,
                                     std::span<const std::size_t> corner_bits) {
  std::vector<double> coordinates;
  for (const std::size_t bits : corner_bits) {
    for (std::size_t d = 0; d < 3; ++d) {
      coordinates.push_back((bits >> d & 1) != 0 ? lengths[d] : 0);
    }
  }
  const std::size_t size = element_layout(type).size();
  std::vector<double> stiffness(size * size);
  std::vector<double> mass(size);
  element_matrices(type, coordinates, properties, stiffness, mass);
  return stiffness;
}

}  // namespace

std::vector<double> stiffness_by_parity(ElementType type, const ElementProperties& properties,
                                        const Vector3& lengths,
                                        std::span<const std::size_t> corner_bits) {
  const auto stiffness = corner_stiffness(type, properties, lengths, corner_bits);
  const std::size_t nodes = corner_bits.size();
  const std::size_t components = element_layout(type).components;
  const std::size_t size = nodes * components;
  const auto sign = [&](std::size_t s, std::size_t node) {
    return std::popcount(s & ~corner_bits[node]) % 2 == 0 ? 1.0 : -1.0;
  };
  const auto scale = static_cast<double>(nodes * nodes);
  std::vector<double> half(size * size, 0.0);  // H K / n^2
  std::vector<double> result(size * size, 0.0);
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t s = 0; s < nodes; ++s) {
      for (std::size_t a = 0; a < nodes; ++a) {
        for (std::size_t j = 0; j < size; ++j) {
          half[(s + nodes * c) * size + j] +=
              sign(s, a) * stiffness[(components * a + c) * size + j] / scale;
        }
      }
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      for (std::size_t s = 0; s < nodes; ++s) {
        for (std::size_t a = 0; a < nodes; ++a) {
          result[i * size + s + nodes * c] += half[i * size + components * a + c] * sign(s, a);
        }
      }
    }
  }
  return result;
}

BlockPicker::BlockPicker(std::vector<double> matrix)
    : matrix_(std::move(matrix)),
      size_(static_cast<std::size_t>(std::lround(std::sqrt(matrix_.size())))),
      scale_(largest_magnitude(matrix_)) {}

double BlockPicker::take(std::size_t i, std::size_t j) {
  const double value = matrix_[i * size_ + j];
  matrix_[i * size_ + j] = 0;
  matrix_[j * size_ + i] = 0;
  return value;
}

std::array<double, 3> BlockPicker::take2(std::size_t i, std::size_t j) {
  return {take(i, i), take(i, j), take(j, j)};
}

std::array<double, 6> BlockPicker::take3(std::size_t i, std::size_t j, std::size_t k) {
  return {take(i, i), take(i, j), take(i, k), take(j, j), take(j, k), take(k, k)};
}

bool BlockPicker::took_all() const {
  return largest_magnitude(matrix_) <= largest_leak * scale_;
}

}  // namespace pounding::stiffness
