#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "common/matrix3.h"
#include "stiffness/strains/element_lanes.h"

namespace pounding::stiffness {

// Strains of a vector field in a plane, of a batch of elements at once.

/// Gradient of a field times J: (y_r f_p - y_p f_r, x_p f_r - x_r f_p).
struct PlaneGradient {
  ElementLanes x, y;
};

/// Two vectors of the plane between which gradients are taken.
struct PlaneFrame {
  ElementLanes x_p, y_p, x_r, y_r;

  __attribute__((always_inline)) PlaneGradient gradient(const ElementLanes& f_p,
                                                        const ElementLanes& f_r) const {
    return {less(y_r * f_p, y_p, f_r), less(x_p * f_r, x_r, f_p)};
  }
  /// Force that works on f_p; the next one, on f_r.
  __attribute__((always_inline)) ElementLanes along_p(const PlaneGradient& g) const {
    return less(y_r * g.x, x_r, g.y);
  }
  __attribute__((always_inline)) ElementLanes along_r(const PlaneGradient& g) const {
    return less(x_p * g.y, y_p, g.x);
  }
};

/// Stress of plane strains: moduli of the sum, and of the difference and slip. The gradients of
/// both components become what works on them.
template <typename Numbers>
static inline __attribute__((always_inline)) void plane_stress(Numbers moduli, PlaneGradient& of_x,
                                                               PlaneGradient& of_y) {
  const ElementLanes sum = moduli[0] * (of_x.x + of_y.y);
  const ElementLanes difference = moduli[1] * (of_x.x - of_y.y);
  const ElementLanes slip = moduli[1] * (of_x.y + of_y.x);
  of_x = {sum + difference, slip};
  of_y = {slip, sum - difference};
}

/// Displacement fields of a flat shell in its own axes, z normal to the plane, and the energies
/// that a stiffness in global axes gives them: the numbers of its strains.
template <std::size_t nodes>
struct ShellFields {
  static constexpr std::size_t size = 6 * nodes;
  using Field = std::array<double, size>;  ///< of the feet in the plane, six components per node

  Matrix3 frame{};  ///< local axes, in rows
  std::array<double, nodes> x{}, y{};
  std::array<double, nodes> heights{};  ///< of the nodes above their feet

  /// Shear along the edge from node `edge` to the next one, without any other strain: fibres that
  /// turn about the normal, and deflections that follow them along the other edges.
  Field edge_shear(std::size_t edge, double jacobian) const {
    Field field{};
    const double turn = 1 / (2 * jacobian);
    for (std::size_t a = 0; a < nodes; ++a) {
      field[6 * a + 4] = -turn * y[a];
      field[6 * a + 3] = -turn * x[a];
    }
    return with_deflections(field, edge);
  }

  /// Moduli of strains times J and of curvatures times J: of the sum, of difference and slip.
  void put_moduli(double jacobian, std::span<const double> stiffness, double* stretch,
                  double* bend) const {
    Field stretched{}, sheared{}, bent{}, twisted{};
    const double scale = 1 / jacobian;
    for (std::size_t a = 0; a < nodes; ++a) {
      stretched[6 * a] = scale * x[a];
      sheared[6 * a] = scale * y[a];
      sheared[6 * a + 1] = scale * x[a];
      bent[6 * a + 4] = scale * x[a];
      twisted[6 * a + 4] = scale * y[a];
      twisted[6 * a + 3] = -scale * x[a];
    }
    const auto put = [&](const Field& one, const Field& two, double* moduli) {
      moduli[1] = energy(two, stiffness) / 4;
      moduli[0] = energy(one, stiffness) - moduli[1];
    };
    put(stretched, sheared, stretch);
    put(with_deflections(bent, nodes), with_deflections(twisted, nodes), bend);
  }

  /// Lower triangle of the products of fields by the stiffness, row by row.
  template <std::size_t count>
  void put_energies(const std::array<Field, count>& fields, std::span<const double> stiffness,
                    double* energies) const {
    std::array<Field, count> global{};
    for (std::size_t i = 0; i < count; ++i) {
      global[i] = to_global(fields[i]);
      const Field force = multiplied(stiffness, global[i]);
      for (std::size_t j = 0; j <= i; ++j) *energies++ = product(global[j], force);
    }
  }

 private:
  static double product(const Field& a, const Field& b) {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) sum += a[i] * b[i];
    return sum;
  }

  static Field multiplied(std::span<const double> stiffness, const Field& field) {
    Field force{};  // the matrix is symmetric: by columns, which the compiler takes in vectors
    for (std::size_t j = 0; j < size; ++j) {
      for (std::size_t i = 0; i < size; ++i) force[i] += stiffness[j * size + i] * field[j];
    }
    return force;
  }

  double energy(const Field& field, std::span<const double> stiffness) const {
    const Field global = to_global(field);
    return product(global, multiplied(stiffness, global));
  }

  /// The deflections with which no edge shears but one: twice w_b - w_a + (mean fibre) times
  /// (x_b - x_a) is 1 there.
  Field with_deflections(Field field, std::size_t sheared_edge) const {
    for (std::size_t a = 0; a + 1 < nodes; ++a) {
      const std::size_t b = a + 1;
      const double along = (field[6 * a + 4] + field[6 * b + 4]) * (x[b] - x[a]) -
                           (field[6 * a + 3] + field[6 * b + 3]) * (y[b] - y[a]);
      field[6 * b + 2] = field[6 * a + 2] + ((a == sheared_edge ? 1 : 0) - along) / 2;
    }
    return field;
  }

  /// Field in global axes, of the nodes instead of their feet.
  Field to_global(Field field) const {
    for (std::size_t a = 0; a < nodes; ++a) {
      double* const node = &field[6 * a];
      node[0] += heights[a] * node[4];
      node[1] -= heights[a] * node[3];
      for (const std::size_t c : {0, 3}) {
        const Vector3 local{node[c], node[c + 1], node[c + 2]};
        for (std::size_t d = 0; d < 3; ++d) {
          node[c + d] = frame[0][d] * local[0] + frame[1][d] * local[1] + frame[2][d] * local[2];
        }
      }
    }
    return field;
  }
};

}  // namespace pounding::stiffness
