#include "stiffness/shells/shell_chain.h"

#include <cstddef>

#include "common/lanes.h"

namespace pounding::stiffness {
namespace {

/// The argument at four dofs in a row.
inline void load_argument(const StiffnessArgument& w, LocalIndex dof, Lanes& values) {
  Lanes velocity;
  load(w.displacement + dof, values);
  load(w.velocity + dof, velocity);
  values += w.beta * velocity;
}

/// Four vectors; variables of their own, which stay in registers.
struct FourLanes {
  Lanes a, b, c, d;
};

/// Four values of four nodes, node by node, to value by value; its own inverse.
inline void transpose(FourLanes& v) {
  const Lanes even_ab = __builtin_shufflevector(v.a, v.b, 0, 4, 2, 6);
  const Lanes even_cd = __builtin_shufflevector(v.c, v.d, 0, 4, 2, 6);
  const Lanes odd_ab = __builtin_shufflevector(v.a, v.b, 1, 5, 3, 7);
  const Lanes odd_cd = __builtin_shufflevector(v.c, v.d, 1, 5, 3, 7);
  v.a = __builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5);
  v.b = __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5);
  v.c = __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7);
  v.d = __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7);
}

/// The components from `begin` on of four nodes.
inline void load_components(const StiffnessArgument& w, const LocalIndex* places, int begin,
                            FourLanes& v) {
  load_argument(w, places[0] + begin, v.a);
  load_argument(w, places[1] + begin, v.b);
  load_argument(w, places[2] + begin, v.c);
  load_argument(w, places[3] + begin, v.d);
  transpose(v);
}

inline void load_four(const StiffnessArgument& w, const LocalIndex* places, int p,
                      const SixArrays& to) {
  FourLanes v;
  load_components(w, places, 0, v);
  store(to[0] + p, v.a);
  store(to[1] + p, v.b);
  load_components(w, places, 2, v);
  store(to[2] + p, v.a);
  store(to[3] + p, v.b);
  store(to[4] + p, v.c);
  store(to[5] + p, v.d);
}

/// Stores the forces of nodes; `q`: where dof 0 would stand.
inline void store_components(const double* x, const double* y, const double* z, const double* t,
                             const LocalIndex* places, double* q) {
  FourLanes v;
  load(x, v.a);
  load(y, v.b);
  load(z, v.c);
  load(t, v.d);
  transpose(v);
  store(q + places[0], v.a);
  store(q + places[1], v.b);
  store(q + places[2], v.c);
  store(q + places[3], v.d);
}

inline void store_four(const SixArrays& from, int p, const LocalIndex* places, LocalIndex first,
                       double* q) {
  store_components(from[0] + p, from[1] + p, from[2] + p, from[3] + p, places, q - first);
  store_components(from[2] + p, from[3] + p, from[4] + p, from[5] + p, places, q - first + 2);
}

}  // namespace

void load_shell_nodes(const StiffnessArgument& w, const LocalIndex* places, int count,
                      const SixArrays& to) {
  if (count < 4) {
    for (int p = 0; p < count; ++p) {
      for (std::size_t c = 0; c < 6; ++c) to[c][p] = w[places[p] + static_cast<LocalIndex>(c)];
    }
    return;
  }
  for (int p = 0; p + 4 <= count; p += 4) load_four(w, places + p, p, to);
  if (count % 4 != 0) load_four(w, places + count - 4, count - 4, to);
}

void store_shell_nodes(const SixArrays& from, const LocalIndex* places, int count, LocalIndex first,
                       double* q) {
  if (count < 4) {
    for (int p = 0; p < count; ++p) {
      for (std::size_t c = 0; c < 6; ++c) {
        q[places[p] - first + static_cast<LocalIndex>(c)] = from[c][p];
      }
    }
    return;
  }
  for (int p = 0; p + 4 <= count; p += 4) store_four(from, p, places + p, first, q);
  if (count % 4 != 0) store_four(from, count - 4, places + count - 4, first, q);
}

}  // namespace pounding::stiffness
