#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "dense_model.h"

namespace pounding::testing_support {

/// Corner coordinates, shape (8, 3), of a box of edges a, b, c with its lowest corner at the
/// origin.
inline std::vector<double> box(double a, double b, double c) {
  return {0, 0, 0, a, 0, 0, a, b, 0, 0, b, 0, 0, 0, c, a, 0, c, a, b, c, 0, b, c};
}

/// A box of n[0] x n[1] x n[2] bricks, its face x = 0 clamped; `place` moves the nodes of the
/// regular grid, given their place in it.
struct BrickCantilever {
  DenseModel model;
  std::vector<std::size_t> tip;  ///< nodes of the face x = length
};

using NodePlace = std::function<Vector3(std::array<std::size_t, 3>, Vector3)>;

inline BrickCantilever brick_cantilever(
    ElementType type, std::array<std::size_t, 3> n, const Vector3& lengths,
    const ElementProperties& properties,
    const NodePlace& place = [](auto, Vector3 x) { return x; }) {
  const auto index = [&](std::size_t i, std::size_t j, std::size_t k) {
    return (i * (n[1] + 1) + j) * (n[2] + 1) + k;
  };
  std::vector<Vector3> nodes;
  for (std::size_t i = 0; i <= n[0]; ++i)
    for (std::size_t j = 0; j <= n[1]; ++j)
      for (std::size_t k = 0; k <= n[2]; ++k) {
        const std::array<std::size_t, 3> at{i, j, k};
        Vector3 x{};
        for (std::size_t d = 0; d < 3; ++d)
          x[d] = lengths[d] * static_cast<double>(at[d]) / static_cast<double>(n[d]);
        nodes.push_back(place(at, x));
      }
  BrickCantilever result{DenseModel(nodes, 3), {}};
  for (std::size_t i = 0; i < n[0]; ++i)
    for (std::size_t j = 0; j < n[1]; ++j)
      for (std::size_t k = 0; k < n[2]; ++k)
        result.model.add(type,
                         {index(i, j, k), index(i + 1, j, k), index(i + 1, j + 1, k),
                          index(i, j + 1, k), index(i, j, k + 1), index(i + 1, j, k + 1),
                          index(i + 1, j + 1, k + 1), index(i, j + 1, k + 1)},
                         properties);
  for (std::size_t j = 0; j <= n[1]; ++j)
    for (std::size_t k = 0; k <= n[2]; ++k) {
      result.model.clamp(index(0, j, k));
      result.tip.push_back(index(n[0], j, k));
    }
  return result;
}

}  // namespace pounding::testing_support
