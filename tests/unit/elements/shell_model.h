#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "dense_model.h"
#include "elements/shell3.h"
#include "elements/shell4.h"

namespace pounding::testing_support {

/// Matrices of a shell of three or four nodes, coordinates of shape (nodes, 3).
inline DenseElement dense_shell(const std::vector<double>& coordinates,
                                const ShellProperties& properties) {
  const std::size_t n = 2 * coordinates.size();
  DenseElement e{std::vector<double>(n * n), std::vector<double>(n)};
  const bool is_triangle = n == 18;
  (is_triangle ? shell3_stiffness : shell4_stiffness)(coordinates, properties, e.stiffness);
  (is_triangle ? shell3_lumped_mass : shell4_lumped_mass)(coordinates, properties, e.lumped_mass);
  return e;
}

/// Shells assembled densely, six components per node, of which the fixed ones are left out.
class ShellModel {
 public:
  explicit ShellModel(std::vector<Vector3> nodes) : nodes_(std::move(nodes)) {
    stiffness_.assign(size() * size(), 0.0);
    lumped_mass_.assign(size(), 0.0);
    is_fixed_.assign(size(), false);
  }

  std::size_t size() const { return 6 * nodes_.size(); }
  const std::vector<Vector3>& nodes() const { return nodes_; }
  const std::vector<double>& stiffness() const { return stiffness_; }
  const std::vector<double>& lumped_mass() const { return lumped_mass_; }

  void add(const std::vector<std::size_t>& element, const ShellProperties& properties) {
    std::vector<double> coordinates;
    for (const std::size_t node : element)
      coordinates.insert(coordinates.end(), nodes_[node].begin(), nodes_[node].end());
    const DenseElement matrices = dense_shell(coordinates, properties);
    const std::size_t n = 6 * element.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t row = 6 * element[i / 6] + i % 6;
      lumped_mass_[row] += matrices.lumped_mass[i];
      for (std::size_t j = 0; j < n; ++j)
        stiffness_[row * size() + 6 * element[j / 6] + j % 6] += matrices.stiffness[i * n + j];
    }
  }

  void fix(std::size_t node, std::size_t component) { is_fixed_[6 * node + component] = true; }
  void clamp(std::size_t node) {
    for (std::size_t c = 0; c < 6; ++c) fix(node, c);
  }
  void fix_everywhere(const std::vector<std::size_t>& components) {
    for (std::size_t node = 0; node < nodes_.size(); ++node)
      for (const std::size_t c : components) fix(node, c);
  }

  std::vector<double> solve(const std::vector<double>& load) const {
    const auto free = free_dofs();
    std::vector<double> reduced;
    for (const std::size_t i : free) reduced.push_back(load[i]);
    reduced = solve_positive_definite(reduced_stiffness(free), reduced);
    std::vector<double> displacement(size(), 0.0);
    for (std::size_t i = 0; i < free.size(); ++i) displacement[free[i]] = reduced[i];
    return displacement;
  }

  /// Natural frequencies, ascending [Hz].
  std::vector<double> frequencies() const {
    const auto free = free_dofs();
    std::vector<double> mass;
    for (const std::size_t i : free) mass.push_back(lumped_mass_[i]);
    auto values = squared_circular_frequencies(reduced_stiffness(free), mass);
    for (double& value : values) value = std::sqrt(std::max(value, 0.0)) / (2 * std::numbers::pi);
    return values;
  }

 private:
  std::vector<std::size_t> free_dofs() const {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < size(); ++i)
      if (!is_fixed_[i]) free.push_back(i);
    return free;
  }

  std::vector<double> reduced_stiffness(const std::vector<std::size_t>& free) const {
    std::vector<double> reduced;
    reduced.reserve(free.size() * free.size());
    for (const std::size_t i : free)
      for (const std::size_t j : free) reduced.push_back(stiffness_[i * size() + j]);
    return reduced;
  }

  std::vector<Vector3> nodes_;
  std::vector<double> stiffness_;
  std::vector<double> lumped_mass_;
  std::vector<bool> is_fixed_;
};

/// How the cells of a grid are cut: quadrangles, triangles by one diagonal or by alternating ones.
enum class Cells { quadrangles, triangles, crossed_triangles };

/// A grid of nx x ny cells over [0, 1] x [0, 1], carried to its place by `map`; node (i, j) has
/// number i (ny + 1) + j.
inline ShellModel shell_grid(std::size_t nx, std::size_t ny, const ShellProperties& properties,
                             Cells cells, const std::function<Vector3(double, double)>& map) {
  std::vector<Vector3> nodes;
  for (std::size_t i = 0; i <= nx; ++i)
    for (std::size_t j = 0; j <= ny; ++j)
      nodes.push_back(map(static_cast<double>(i) / static_cast<double>(nx),
                          static_cast<double>(j) / static_cast<double>(ny)));
  ShellModel model(std::move(nodes));
  for (std::size_t i = 0; i < nx; ++i)
    for (std::size_t j = 0; j < ny; ++j) {
      const std::size_t a = i * (ny + 1) + j, b = a + ny + 1, c = b + 1, d = a + 1;
      if (cells == Cells::quadrangles) {
        model.add({a, b, c, d}, properties);
      } else if (cells == Cells::triangles || (i + j) % 2 == 0) {
        model.add({a, b, c}, properties);
        model.add({a, c, d}, properties);
      } else {
        model.add({a, b, d}, properties);
        model.add({b, c, d}, properties);
      }
    }
  return model;
}

/// Square plate of side `side` in the x-y plane, held so that it only bends.
inline ShellModel square_plate(std::size_t n, double side, const ShellProperties& properties,
                               Cells cells = Cells::quadrangles) {
  auto model = shell_grid(n, n, properties, cells, [&](double r, double s) {
    return Vector3{side * r, side * s, 0};
  });
  model.fix_everywhere({0, 1, 5});
  return model;
}

/// Deflection and tangential rotation held on the four sides of a square plate.
inline void support_hard(ShellModel& model, double side) {
  for (std::size_t node = 0; node < model.nodes().size(); ++node)
    for (std::size_t i = 0; i < 2; ++i) {
      const double x = model.nodes()[node][i];
      if (std::min(x, side - x) > 1e-9 * side) continue;
      model.fix(node, 2);
      model.fix(node, 3 + i);  // on x = const the rotation about x is dw/dy = 0
    }
}

inline void clamp_left(ShellModel& model) {
  for (std::size_t node = 0; node < model.nodes().size(); ++node)
    if (model.nodes()[node][0] == 0) model.clamp(node);
}

}  // namespace pounding::testing_support
