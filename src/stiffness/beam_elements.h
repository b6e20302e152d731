#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/batch_value.h"
#include "common/lanes.h"
#include "common/matrix3.h"
#include "common/types.h"
#include "elements/element_traits.h"

namespace pounding::stiffness {

/// Three components of four beams, or of one beam in several runs.
template <typename Value>
struct VectorsOf {
  Value x, y, z;
};

/// Beams, four at a time, from their ten local stiffnesses and their axes instead of 12 x 12
/// matrices. With d = u_1 - u_2, the rotations r_1, r_2 in local axes, and Phi of beam2.h, which is
/// 0 without flexibility in shear:
///
///     f_x = E A / L d_x                          t_1 = -t_2 = G J / L (r_1x - r_2x)
///     f_y = (12 E I_z / L^3 d_y + 6 E I_z / L^2 (r_1z + r_2z)) / (1 + Phi)
///     m_1z = (6 E I_z / L^2 d_y + E I_z / L ((4 + Phi) r_1z + (2 - Phi) r_2z)) / (1 + Phi)
///
/// and likewise f_z, m_y with E I_y and the other sign of the terms in L^2; node 2 takes -f.
class BeamElements {
 public:
  struct Beam {
    /// Slots of the six dofs in a row of each node.
    std::array<LocalIndex, 2> start{};
    Matrix3 axes{};  ///< rows x, y, z
    double stretch = 0;
    double twist = 0;
    /// Stiffness of u_y and r_z: 12 E I_z / (L^3 (1 + Phi)), 6 E I_z / (L^2 (1 + Phi)),
    /// 2 E I_z / L, and the pure number (2 - Phi) / (2 + 2 Phi).
    std::array<double, 4> bending_y{};
    std::array<double, 4> bending_z{};  ///< the same of I_y: u_z, r_y
  };
  /// A beam with node coordinates of shape (2, 3) [m].
  static Beam make(const std::array<LocalIndex, 2>& start, std::span<const double> coordinates,
                   const ElementProperties& properties);

  /// `idle`: slot of six dofs that no node uses, for the lanes of the last batch.
  BeamElements(const std::vector<Beam>& beams, LocalIndex idle);

  /// q += K w; both arrays hold all slots. Allocates nothing.
  void apply(const double* w, double* q) const;
  /// q += K w in eight runs, one beam after the other.
  void apply(const BatchValue* w, BatchValue* q) const;

 private:
  struct Batch {
    std::array<std::array<LocalIndex, 4>, 2> start{};
    Lanes axes[9] = {};
    Lanes stretch = {};
    Lanes twist = {};
    Lanes bending_y[4] = {};
    Lanes bending_z[4] = {};
  };
  template <typename Value>
  static void product(const Batch& beams, const auto& number, VectorsOf<Value> (&ends)[4]);

  std::vector<Batch> batches_;
};

}  // namespace pounding::stiffness
