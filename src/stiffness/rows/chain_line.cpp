#include "stiffness/rows/chain_line.h"

#include "common/lanes.h"

namespace pounding::stiffness {
namespace {

/// The argument at four dofs in a row, of which `first` is a direction.
template <std::size_t first>
inline void load_argument(const StiffnessArgument& w, LocalIndex dof, Lanes& values) {
  Lanes velocity;
  load(w.displacement + dof, values);
  load(w.velocity + dof, velocity);
  values += w.beta * velocity;
  values -= Lanes{w.origin[first % 3], w.origin[(first + 1) % 3], w.origin[(first + 2) % 3],
                  w.origin[first % 3]};
}

inline double load_component(const StiffnessArgument& w, LocalIndex node, std::size_t component) {
  return w[node + static_cast<LocalIndex>(component)] - w.origin[component];
}

inline void load_node(const StiffnessArgument& w, LocalIndex dof, int p,
                      const ComponentArrays& to) {
  to.x[p] = load_component(w, dof, 0);
  to.y[p] = load_component(w, dof, 1);
  to.z[p] = load_component(w, dof, 2);
}

inline void store_node(const ComponentArrays& from, int p, double* q) {
  q[0] = from.x[p];
  q[1] = from.y[p];
  q[2] = from.z[p];
}

/// Four nodes in a row in memory, x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3.
struct FourNodes {
  Lanes a, b, c;
};

inline void load_row_of_four(const StiffnessArgument& w, LocalIndex first, FourNodes& nodes) {
  load_argument<0>(w, first, nodes.a);
  load_argument<1>(w, first + 4, nodes.b);
  load_argument<2>(w, first + 8, nodes.c);
}

inline void to_components(const FourNodes& nodes, int p, const ComponentArrays& to) {
  const Lanes xy_02 = __builtin_shufflevector(nodes.a, nodes.b, 0, 1, 6, 7);
  const Lanes zx_02 = __builtin_shufflevector(nodes.a, nodes.c, 2, 3, 4, 5);
  const Lanes yz_13 = __builtin_shufflevector(nodes.b, nodes.c, 0, 1, 6, 7);
  store(to.x + p, __builtin_shufflevector(xy_02, zx_02, 0, 5, 2, 7));
  store(to.y + p, __builtin_shufflevector(xy_02, yz_13, 1, 4, 3, 6));
  store(to.z + p, __builtin_shufflevector(zx_02, yz_13, 0, 5, 2, 7));
}

inline void from_components(const Lanes& x, const Lanes& y, const Lanes& z, double* q) {
  const Lanes xy_02 = __builtin_shufflevector(x, y, 0, 4, 2, 6);
  const Lanes zx_02 = __builtin_shufflevector(z, x, 0, 5, 2, 7);
  const Lanes yz_13 = __builtin_shufflevector(y, z, 1, 5, 3, 7);
  store(q, __builtin_shufflevector(xy_02, zx_02, 0, 1, 4, 5));
  store(q + 4, __builtin_shufflevector(yz_13, xy_02, 0, 1, 6, 7));
  store(q + 8, __builtin_shufflevector(zx_02, yz_13, 2, 3, 6, 7));
}

/// Calls four(p) for groups of four of `count` nodes; the last group may overlap the one before it.
/// Calls one(p) for each of fewer nodes.
template <typename Four, typename One>
inline void by_fours(int count, Four four, One one) {
  if (count < 4) {
    for (int p = 0; p < count; ++p) one(p);
    return;
  }
  for (int p = 0; p + 4 <= count; p += 4) four(p);
  if (count % 4 != 0) four(count - 4);
}

}  // namespace

void load_nodes(const StiffnessArgument& w, const LocalIndex* places, int count,
                const ComponentArrays& to) {
  for (int p = 0; p < count; ++p) load_node(w, places[p], p, to);
}

void load_row(const StiffnessArgument& w, LocalIndex first, int count, const ComponentArrays& to) {
  by_fours(
      count,
      [&](int p) {
        FourNodes nodes;
        load_row_of_four(w, first + 3 * p, nodes);
        to_components(nodes, p, to);
      },
      [&](int p) { load_node(w, first + 3 * p, p, to); });
}

void load_row_pair(const StiffnessArgument& w, std::array<LocalIndex, 2> first, int count,
                   const ComponentArrays& sum, const ComponentArrays& difference) {
  by_fours(
      count,
      [&](int p) {
        FourNodes near, far;
        load_row_of_four(w, first[0] + 3 * p, near);
        load_row_of_four(w, first[1] + 3 * p, far);
        to_components({far.a + near.a, far.b + near.b, far.c + near.c}, p, sum);
        to_components({far.a - near.a, far.b - near.b, far.c - near.c}, p, difference);
      },
      [&](int p) {
        const LocalIndex near = first[0] + 3 * p;
        const LocalIndex far = first[1] + 3 * p;
        const auto at = [&](LocalIndex node, std::size_t c) { return load_component(w, node, c); };
        sum.x[p] = at(far, 0) + at(near, 0);
        sum.y[p] = at(far, 1) + at(near, 1);
        sum.z[p] = at(far, 2) + at(near, 2);
        difference.x[p] = at(far, 0) - at(near, 0);
        difference.y[p] = at(far, 1) - at(near, 1);
        difference.z[p] = at(far, 2) - at(near, 2);
      });
}

void store_nodes(const ComponentArrays& from, const LocalIndex* places, int count, LocalIndex first,
                 double* q) {
  for (int p = 0; p < count; ++p) store_node(from, p, q + (places[p] - first));
}

void store_row(const ComponentArrays& from, int count, double* q) {
  by_fours(
      count,
      [&](int p) {
        Lanes x, y, z;
        load(from.x + p, x);
        load(from.y + p, y);
        load(from.z + p, z);
        from_components(x, y, z, q + 3 * p);
      },
      [&](int p) { store_node(from, p, q + 3 * p); });
}

void rotate_vectors(const Matrix3& rotation, bool back, int count, std::ptrdiff_t stride,
                    double* line) {
  Matrix3 r = rotation;
  if (back) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) r[i][j] = rotation[j][i];
    }
  }
  for (int p = 0; p < count; ++p) {
    const Vector3 v = multiply(r, {line[p], line[stride + p], line[2 * stride + p]});
    line[p] = v[0];
    line[stride + p] = v[1];
    line[2 * stride + p] = v[2];
  }
}

}  // namespace pounding::stiffness
