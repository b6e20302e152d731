#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "dense_model.h"

namespace pounding::testing_support {

/// Concrete without Poisson effect, so that a slender body is the beam of the textbooks.
inline ElementProperties cantilever_material() {
  return {.young = 30e9, .density = 2400};
}

/// Nodes of one cell of a grid, bottom then top, cut into elements of a type: hexahedra whole,
/// two wedges, six tetrahedra.
inline std::vector<std::vector<std::size_t>> cut_cell(ElementType type,
                                                      const std::array<std::size_t, 8>& n) {
  if (type == ElementType::wedge6)
    return {{n[0], n[1], n[2], n[4], n[5], n[6]}, {n[0], n[2], n[3], n[4], n[6], n[7]}};
  if (type == ElementType::tet4)
    return {{n[0], n[1], n[2], n[6]}, {n[0], n[2], n[3], n[6]}, {n[0], n[3], n[7], n[6]},
            {n[0], n[7], n[4], n[6]}, {n[0], n[4], n[5], n[6]}, {n[0], n[5], n[1], n[6]}};
  return {{n.begin(), n.end()}};
}

/// First frequency [Hz] of a cantilever of edges `lengths` in n[0] x n[1] x n[2] cut cells.
inline double first_frequency(ElementType type, std::array<std::size_t, 3> n,
                              const Vector3& lengths) {
  const auto index = [&](std::size_t i, std::size_t j, std::size_t k) {
    return (i * (n[1] + 1) + j) * (n[2] + 1) + k;
  };
  std::vector<Vector3> nodes;
  for (std::size_t i = 0; i <= n[0]; ++i)
    for (std::size_t j = 0; j <= n[1]; ++j)
      for (std::size_t k = 0; k <= n[2]; ++k)
        nodes.push_back({lengths[0] * static_cast<double>(i) / static_cast<double>(n[0]),
                         lengths[1] * static_cast<double>(j) / static_cast<double>(n[1]),
                         lengths[2] * static_cast<double>(k) / static_cast<double>(n[2])});
  DenseModel model(nodes, 3);
  for (std::size_t i = 0; i < n[0]; ++i)
    for (std::size_t j = 0; j < n[1]; ++j)
      for (std::size_t k = 0; k < n[2]; ++k)
        for (const auto& element :
             cut_cell(type, {index(i, j, k), index(i + 1, j, k), index(i + 1, j + 1, k),
                             index(i, j + 1, k), index(i, j, k + 1), index(i + 1, j, k + 1),
                             index(i + 1, j + 1, k + 1), index(i, j + 1, k + 1)}))
          model.add(type, element, cantilever_material());
  for (std::size_t j = 0; j <= n[1]; ++j)
    for (std::size_t k = 0; k <= n[2]; ++k) model.clamp(index(0, j, k));
  return model.frequencies().front();
}

/// That of the beam of Euler and Bernoulli [Hz], bending across `depth`.
inline double beam_frequency(double length, double depth) {
  const ElementProperties p = cantilever_material();
  const double root = 1.8751040687119611;
  return root * root / (2 * std::numbers::pi) / (length * length) *
         std::sqrt(p.young * depth * depth / 12 / p.density);
}

/// Largest |u_i| by which a motion of uniform strain of all nodes fails to leave the listed nodes
/// of a model without force, relative to the largest force on any node.
inline double patch_residual(const DenseModel& model, const std::vector<std::size_t>& inner_nodes) {
  std::vector<double> u;
  for (const Vector3& x : model.nodes())
    for (std::size_t i = 0; i < 3; ++i) u.push_back(0.5e-3 * (x[0] + x[1] + x[2] + x[i]));
  const std::vector<double> force = multiply(model.stiffness(), u);
  double largest = 0;
  double inside = 0;
  for (const double f : force) largest = std::max(largest, std::abs(f));
  for (const std::size_t node : inner_nodes)
    for (std::size_t i = 0; i < 3; ++i) inside = std::max(inside, std::abs(force[3 * node + i]));
  return inside / largest;
}

}  // namespace pounding::testing_support
