#pragma once

#include <array>

#include "common/types.h"

namespace pounding {

/// Node of absorbing faces: the endless continuation of the solids behind them resists its velocity
/// by C = sum over faces of A_i rho (V_p n n^T + V_s (I - n n^T)), with A_i the node's share of a
/// face's area, n its unit normal, rho, V_p, V_s of the element behind it (Lysmer and Kuhlemeyer,
/// J. Eng. Mech. Div. 95 (1969)). As dashpots, each along one axis,
///
///     C = sum_k c_k a_k a_k^T,      force of a wave from below = sum_k a_k (w_k . v_in)
///
/// with |a_k| = 1, the scaled columns of the Cholesky factor of C.
struct AbsorbingNode {
  GlobalIndex node = 0;               ///< file order
  std::array<Vector3, 3> axis{};      ///< a_k
  Vector3 dashpot{};                  ///< c_k [N s/m]
  std::array<Vector3, 3> incident{};  ///< w_k [N s/m]; zero away from the base
};

}  // namespace pounding
