#include "system/shell_chain.h"

#include <cstddef>

#include "system/lanes.h"

namespace pounding {
namespace {

/// The argument at four dofs in a row.
inline void load_argument(const StiffnessArgument& w, LocalIndex dof, Lanes& values) {
  Lanes velocity;
  load(w.displacement + dof, values);
  load(w.velocity + dof, velocity);
  values += w.beta * velocity;
}

/// Four values of four nodes, node by node, to value by value; its own inverse.
inline void transpose(Lanes (&v)[4]) {
  const Lanes even_01 = __builtin_shuffle(v[0], v[1], LaneMask{0, 4, 2, 6});
  const Lanes even_23 = __builtin_shuffle(v[2], v[3], LaneMask{0, 4, 2, 6});
  const Lanes odd_01 = __builtin_shuffle(v[0], v[1], LaneMask{1, 5, 3, 7});
  const Lanes odd_23 = __builtin_shuffle(v[2], v[3], LaneMask{1, 5, 3, 7});
  v[0] = __builtin_shuffle(even_01, even_23, LaneMask{0, 1, 4, 5});
  v[1] = __builtin_shuffle(odd_01, odd_23, LaneMask{0, 1, 4, 5});
  v[2] = __builtin_shuffle(even_01, even_23, LaneMask{2, 3, 6, 7});
  v[3] = __builtin_shuffle(odd_01, odd_23, LaneMask{2, 3, 6, 7});
}

// Six values of a node are two whole vectors: components 0-3, and 2-5.

inline void load_four(const StiffnessArgument& w, const LocalIndex* places, int p,
                      const SixArrays& to) {
  for (std::size_t begin = 0; begin < 4; begin += 2) {
    Lanes v[4];
    for (std::size_t k = 0; k < 4; ++k) {
      load_argument(w, places[k] + static_cast<LocalIndex>(begin), v[k]);
    }
    transpose(v);
    for (std::size_t c = 0; c < 4; ++c) store(to[begin + c] + p, v[c]);
  }
}

inline void store_four(const SixArrays& from, int p, const LocalIndex* places, LocalIndex first,
                       double* q) {
  for (std::size_t begin = 0; begin < 4; begin += 2) {
    Lanes v[4];
    for (std::size_t c = 0; c < 4; ++c) load(from[begin + c] + p, v[c]);
    transpose(v);
    for (std::size_t k = 0; k < 4; ++k) {
      store(q + (places[k] - first) + static_cast<LocalIndex>(begin), v[k]);
    }
  }
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

}  // namespace pounding
