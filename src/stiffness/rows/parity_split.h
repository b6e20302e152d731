#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "elements/element_traits.h"

/// How the matrix of an element that is unchanged by reflections falls apart into small blocks.
namespace pounding::stiffness {

/// B of an element with n nodes (4 or 8) at the corners of a rectangle or box with edges `lengths`
/// [m]: bit d of corner_bits[a] says that node a is on the far side of axis d.
///
///     B = H K H' / n^2,   K = H' B H
///
/// H is the Walsh-Hadamard transform, entries prod_d of -1 (near) or +1 (far) over the axes d that
/// are set in the number of its row; value s + n c of B is component c in row s of H. Shape
/// (size, size) for an element of that size. Throws ElementError.
std::vector<double> stiffness_by_parity(ElementType type, const ElementProperties& properties,
                                        const Vector3& lengths,
                                        std::span<const std::size_t> corner_bits);

/// Takes named entries out of B; what is left over when all are taken does not fit the pattern.
class BlockPicker {
 public:
  explicit BlockPicker(std::vector<double> matrix);

  /// Entry of the values i and j, and its mirror.
  double take(std::size_t i, std::size_t j);
  double take1(std::size_t i) { return take(i, i); }
  /// 00 01 11 of the block of two values.
  std::array<double, 3> take2(std::size_t i, std::size_t j);
  /// 00 01 02 11 12 22 of the block of three values.
  std::array<double, 6> take3(std::size_t i, std::size_t j, std::size_t k);

  /// Whether the rest is round-off: at most 1e-13 of the largest entry.
  bool took_all() const;

 private:
  std::vector<double> matrix_;
  std::size_t size_;
  double scale_;
};

}  // namespace pounding::stiffness
