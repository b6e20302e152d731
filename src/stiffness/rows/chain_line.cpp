#include "stiffness/rows/chain_line.h"

#include <utility>

#include "common/wide_lanes.h"

namespace pounding::stiffness {
namespace {

/// The argument at dofs in a row, as many as a vector has lanes, of which `first` is a direction.
template <std::size_t first, typename Vector>
inline void load_argument(const StiffnessArgument& w, LocalIndex dof, Vector& values) {
  Vector velocity;
  load(w.displacement + dof, values);
  load(w.velocity + dof, velocity);
  values += w.beta * velocity;
  values -= [&]<std::size_t... lane>(std::index_sequence<lane...>) {
    return Vector{w.origin[(first + lane) % 3]...};
  }
  (std::make_index_sequence<sizeof(Vector) / sizeof(double)>{});
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

/// Nodes in a row in memory, of four x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3.
template <typename Vector>
struct RowNodes {
  Vector a, b, c;
};

template <typename Vector>
inline RowNodes<Vector> load_row_of_nodes(const StiffnessArgument& w, LocalIndex first) {
  constexpr LocalIndex width = sizeof(Vector) / sizeof(double);
  RowNodes<Vector> nodes;
  load_argument<0>(w, first, nodes.a);
  load_argument<width>(w, first + width, nodes.b);
  load_argument<2 * width>(w, first + 2 * width, nodes.c);
  return nodes;
}

inline void to_components(const RowNodes<Lanes>& nodes, int p, const ComponentArrays& to) {
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

#ifdef __AVX512F__

/// Nodes in a row of eight: x0 y0 z0 x1 y1 z1 x2 y2, z2 x3 y3 z3 x4 y4 z4 x5, y5 z5 x6 y6 ... z7.
inline void to_components(const RowNodes<WideLanes>& nodes, int p, const ComponentArrays& to) {
  const WideLanes x = __builtin_shufflevector(nodes.a, nodes.b, 0, 3, 6, 9, 12, 15, -1, -1);
  const WideLanes y = __builtin_shufflevector(nodes.a, nodes.b, 1, 4, 7, 10, 13, -1, -1, -1);
  const WideLanes z = __builtin_shufflevector(nodes.a, nodes.b, 2, 5, 8, 11, 14, -1, -1, -1);
  store(to.x + p, __builtin_shufflevector(x, nodes.c, 0, 1, 2, 3, 4, 5, 10, 13));
  store(to.y + p, __builtin_shufflevector(y, nodes.c, 0, 1, 2, 3, 4, 8, 11, 14));
  store(to.z + p, __builtin_shufflevector(z, nodes.c, 0, 1, 2, 3, 4, 9, 12, 15));
}

inline void from_components(const WideLanes& x, const WideLanes& y, const WideLanes& z, double* q) {
  const WideLanes a = __builtin_shufflevector(x, y, 0, 8, -1, 1, 9, -1, 2, 10);
  const WideLanes b = __builtin_shufflevector(x, y, -1, 3, 11, -1, 4, 12, -1, 5);
  const WideLanes c = __builtin_shufflevector(x, y, 13, -1, 6, 14, -1, 7, 15, -1);
  store(q, __builtin_shufflevector(a, z, 0, 1, 8, 3, 4, 9, 6, 7));
  store(q + 8, __builtin_shufflevector(b, z, 10, 1, 2, 11, 4, 5, 12, 7));
  store(q + 16, __builtin_shufflevector(c, z, 0, 13, 2, 3, 14, 5, 6, 15));
}

#endif

/// The argument at four dofs in a row of each of the nodes of a row of `load_rows`.
template <typename Vector>
inline void load_argument(const StiffnessArgument& w, const LocalIndex* slots, int begin,
                          Vector& values) {
  Vector velocity;
  load_rows(w.displacement + begin, slots, values);
  load_rows(w.velocity + begin, slots, velocity);
  values += w.beta * velocity;
}

/// Four vectors; variables of their own, which stay in registers.
template <typename Vector>
struct FourVectors {
  Vector a, b, c, d;
};

/// The components from `begin` on of as many nodes as a vector has lanes.
template <typename Vector>
inline void load_components(const StiffnessArgument& w, const LocalIndex* slots, int begin,
                            FourVectors<Vector>& v) {
  load_argument(w, slots, begin, v.a);
  load_argument(w, slots + 1, begin, v.b);
  load_argument(w, slots + 2, begin, v.c);
  load_argument(w, slots + 3, begin, v.d);
  transpose(v.a, v.b, v.c, v.d);
}

/// Loads as many nodes as a vector has lanes.
template <typename Vector>
inline void load_vector(const StiffnessArgument& w, const LocalIndex* slots, int p,
                        const SixArrays& to) {
  FourVectors<Vector> v;
  load_components(w, slots, 0, v);
  store(to[0] + p, v.a);
  store(to[1] + p, v.b);
  load_components(w, slots, 2, v);
  store(to[2] + p, v.a);
  store(to[3] + p, v.b);
  store(to[4] + p, v.c);
  store(to[5] + p, v.d);
}

/// Stores the forces of nodes; `q`: where dof 0 would stand.
template <typename Vector>
inline void store_components(const double* x, const double* y, const double* z, const double* t,
                             const LocalIndex* slots, double* q) {
  FourVectors<Vector> v;
  load(x, v.a);
  load(y, v.b);
  load(z, v.c);
  load(t, v.d);
  transpose(v.a, v.b, v.c, v.d);
  store_rows(v.a, slots, q);
  store_rows(v.b, slots + 1, q);
  store_rows(v.c, slots + 2, q);
  store_rows(v.d, slots + 3, q);
}

template <typename Vector>
inline void store_vector(const SixArrays& from, int p, const LocalIndex* slots, LocalIndex first,
                         double* q) {
  store_components<Vector>(from[0] + p, from[1] + p, from[2] + p, from[3] + p, slots, q - first);
  store_components<Vector>(from[2] + p, from[3] + p, from[4] + p, from[5] + p, slots,
                           q - first + 2);
}

}  // namespace

void load_nodes(const StiffnessArgument& w, const LocalIndex* slots, int count,
                const ComponentArrays& to) {
  for (int p = 0; p < count; ++p) load_node(w, slots[p], p, to);
}

void load_row(const StiffnessArgument& w, LocalIndex first, int count, const ComponentArrays& to) {
  in_groups(
      count,
      [&]<typename Vector>(Vector, int p) {
        to_components(load_row_of_nodes<Vector>(w, first + 3 * p), p, to);
      },
      [&](int p) { load_node(w, first + 3 * p, p, to); });
}

void load_row_pair(const StiffnessArgument& w, std::array<LocalIndex, 2> first, int count,
                   const ComponentArrays& sum, const ComponentArrays& difference) {
  in_groups(
      count,
      [&]<typename Vector>(Vector, int p) {
        using Nodes = RowNodes<Vector>;
        const Nodes near = load_row_of_nodes<Vector>(w, first[0] + 3 * p);
        const Nodes far = load_row_of_nodes<Vector>(w, first[1] + 3 * p);
        to_components(Nodes{far.a + near.a, far.b + near.b, far.c + near.c}, p, sum);
        to_components(Nodes{far.a - near.a, far.b - near.b, far.c - near.c}, p, difference);
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

void store_nodes(const ComponentArrays& from, const LocalIndex* slots, int count, LocalIndex first,
                 double* q) {
  for (int p = 0; p < count; ++p) store_node(from, p, q + (slots[p] - first));
}

void store_row(const ComponentArrays& from, int count, double* q) {
  in_groups(
      count,
      [&]<typename Vector>(Vector, int p) {
        Vector x, y, z;
        load(from.x + p, x);
        load(from.y + p, y);
        load(from.z + p, z);
        from_components(x, y, z, q + 3 * p);
      },
      [&](int p) { store_node(from, p, q + 3 * p); });
}

LineAxes::LineAxes(const Matrix3& frame, const std::array<int, 3>& order)
    : rotated(frame != Matrix3{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}) {
  for (std::size_t d = 0; d < 3; ++d) {
    axes[d] = frame[order[d]];
    component[rotated ? d : order[d]] = static_cast<int>(d);
  }
}

void LineAxes::turn(bool back, int count, std::ptrdiff_t stride, double* line) const {
  if (!rotated) return;
  Matrix3 r = axes;
  for (std::size_t i = 0; back && i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = axes[j][i];
  }
  for (int p = 0; p < count; ++p) {
    const Vector3 v = multiply(r, {line[p], line[stride + p], line[2 * stride + p]});
    line[p] = v[0];
    line[stride + p] = v[1];
    line[2 * stride + p] = v[2];
  }
}

void load_shell_nodes(const StiffnessArgument& w, const LocalIndex* slots, int count,
                      const SixArrays& to) {
  in_groups(
      count, [&]<typename Vector>(Vector, int p) { load_vector<Vector>(w, slots + p, p, to); },
      [&](int p) {
        for (std::size_t c = 0; c < 6; ++c) to[c][p] = w[slots[p] + static_cast<LocalIndex>(c)];
      });
}

void store_shell_nodes(const SixArrays& from, const LocalIndex* slots, int count, LocalIndex first,
                       double* q) {
  in_groups(
      count,
      [&]<typename Vector>(Vector, int p) { store_vector<Vector>(from, p, slots + p, first, q); },
      [&](int p) {
        for (std::size_t c = 0; c < 6; ++c) {
          q[slots[p] - first + static_cast<LocalIndex>(c)] = from[c][p];
        }
      });
}

}  // namespace pounding::stiffness
