#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "dense_model.h"
#include "elements/flat_shell.h"

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
class ShellModel : public DenseModel {
 public:
  explicit ShellModel(std::vector<Vector3> nodes) : DenseModel(std::move(nodes), 6) {}

  void add(const std::vector<std::size_t>& element, const ShellProperties& properties) {
    DenseModel::add(element, dense_shell(coordinates_of(element), properties));
  }
  void fix_everywhere(const std::vector<std::size_t>& components) {
    for (std::size_t node = 0; node < nodes().size(); ++node)
      for (const std::size_t c : components) fix(node, c);
  }
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
