#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/lanes.h"
#include "common/matrix3.h"
#include "common/types.h"
#include "elements/element.h"

namespace pounding::stiffness {

/// Euler-Bernoulli beams, four at a time, from their eight local stiffnesses and their axes instead
/// of 12 x 12 matrices. With d = u_1 - u_2 and the rotations r_1, r_2 in local axes:
///
///     f_x = E A / L d_x                          t_1 = -t_2 = G J / L (r_1x - r_2x)
///     f_y = 12 E I_z / L^3 d_y + 6 E I_z / L^2 (r_1z + r_2z)
///     m_1z = 6 E I_z / L^2 d_y + E I_z / L (4 r_1z + 2 r_2z)
///
/// and likewise f_z, m_y with E I_y and the other sign of the terms in L^2; node 2 takes -f.
class BeamElements {
 public:
  struct Beam {
    /// Places of the six dofs in a row of each node.
    std::array<LocalIndex, 2> start{};
    Matrix3 axes{};  ///< rows x, y, z
    double stretch = 0;
    double twist = 0;
    std::array<double, 3> bending_y{};  ///< 12 E I_z / L^3, 6 E I_z / L^2, 2 E I_z / L: u_y, r_z
    std::array<double, 3> bending_z{};  ///< the same of I_y: u_z, r_y
  };
  /// A beam with node coordinates of shape (2, 3) [m].
  static Beam make(const std::array<LocalIndex, 2>& start, std::span<const double> coordinates,
                   const ElementProperties& properties);

  /// `idle`: place of six dofs that no node uses, for the lanes of the last batch.
  BeamElements(const std::vector<Beam>& beams, LocalIndex idle);

  /// q += K w; both arrays hold all places. Allocates nothing.
  void apply(const double* w, double* q) const;

 private:
  struct Batch {
    std::array<std::array<LocalIndex, 4>, 2> start{};
    Lanes axes[9] = {};
    Lanes stretch = {};
    Lanes twist = {};
    Lanes bending_y[3] = {};
    Lanes bending_z[3] = {};
  };
  std::vector<Batch> batches_;
};

}  // namespace pounding::stiffness
