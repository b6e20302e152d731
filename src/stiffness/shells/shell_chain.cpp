#include "stiffness/shells/shell_chain.h"

#include <cstddef>

#include "common/wide_lanes.h"

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
template <typename Vector>
struct FourVectors {
  Vector a, b, c, d;
};
using FourLanes = FourVectors<Lanes>;

/// The components from `begin` on of four nodes.
inline void load_components(const StiffnessArgument& w, const LocalIndex* places, int begin,
                            FourLanes& v) {
  load_argument(w, places[0] + begin, v.a);
  load_argument(w, places[1] + begin, v.b);
  load_argument(w, places[2] + begin, v.c);
  load_argument(w, places[3] + begin, v.d);
  transpose(v.a, v.b, v.c, v.d);
}

#ifdef __AVX512F__

inline void load_halves(const double* low, const double* high, WideLanes& values) {
  Lanes first, second;
  load(low, first);
  load(high, second);
  values = __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}

inline void load_argument(const StiffnessArgument& w, LocalIndex low, LocalIndex high,
                          WideLanes& values) {
  WideLanes velocity;
  load_halves(w.displacement + low, w.displacement + high, values);
  load_halves(w.velocity + low, w.velocity + high, velocity);
  values += w.beta * velocity;
}

inline void load_components(const StiffnessArgument& w, const LocalIndex* places, int begin,
                            FourVectors<WideLanes>& v) {
  load_argument(w, places[0] + begin, places[4] + begin, v.a);
  load_argument(w, places[1] + begin, places[5] + begin, v.b);
  load_argument(w, places[2] + begin, places[6] + begin, v.c);
  load_argument(w, places[3] + begin, places[7] + begin, v.d);
  transpose(v.a, v.b, v.c, v.d);
}

inline void store_halves(const WideLanes& values, double* low, double* high) {
  store(low, __builtin_shufflevector(values, values, 0, 1, 2, 3));
  store(high, __builtin_shufflevector(values, values, 4, 5, 6, 7));
}

inline void store_rows(const FourVectors<WideLanes>& v, const LocalIndex* places, double* q) {
  store_halves(v.a, q + places[0], q + places[4]);
  store_halves(v.b, q + places[1], q + places[5]);
  store_halves(v.c, q + places[2], q + places[6]);
  store_halves(v.d, q + places[3], q + places[7]);
}

#endif

inline void store_rows(const FourLanes& v, const LocalIndex* places, double* q) {
  store(q + places[0], v.a);
  store(q + places[1], v.b);
  store(q + places[2], v.c);
  store(q + places[3], v.d);
}

/// Loads as many nodes as a vector has lanes.
template <typename Vector>
inline void load_vector(const StiffnessArgument& w, const LocalIndex* places, int p,
                        const SixArrays& to) {
  FourVectors<Vector> v;
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
template <typename Vector>
inline void store_components(const double* x, const double* y, const double* z, const double* t,
                             const LocalIndex* places, double* q) {
  FourVectors<Vector> v;
  load(x, v.a);
  load(y, v.b);
  load(z, v.c);
  load(t, v.d);
  transpose(v.a, v.b, v.c, v.d);
  store_rows(v, places, q);
}

template <typename Vector>
inline void store_vector(const SixArrays& from, int p, const LocalIndex* places, LocalIndex first,
                         double* q) {
  store_components<Vector>(from[0] + p, from[1] + p, from[2] + p, from[3] + p, places, q - first);
  store_components<Vector>(from[2] + p, from[3] + p, from[4] + p, from[5] + p, places,
                           q - first + 2);
}

}  // namespace

void load_shell_nodes(const StiffnessArgument& w, const LocalIndex* places, int count,
                      const SixArrays& to) {
  in_groups(
      count, [&]<typename Vector>(Vector, int p) { load_vector<Vector>(w, places + p, p, to); },
      [&](int p) {
        for (std::size_t c = 0; c < 6; ++c) to[c][p] = w[places[p] + static_cast<LocalIndex>(c)];
      });
}

void store_shell_nodes(const SixArrays& from, const LocalIndex* places, int count, LocalIndex first,
                       double* q) {
  in_groups(
      count,
      [&]<typename Vector>(Vector, int p) { store_vector<Vector>(from, p, places + p, first, q); },
      [&](int p) {
        for (std::size_t c = 0; c < 6; ++c) {
          q[places[p] - first + static_cast<LocalIndex>(c)] = from[c][p];
        }
      });
}

}  // namespace pounding::stiffness
