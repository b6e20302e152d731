#pragma once

#include <memory>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/halo.h"

namespace pounding {

/// Bars that buckle: with the elongation e = t . (w_2 - w_1) of w = u + beta v along the bar's
/// axis, the tension is N = E A / L max(0, e). The one nonlinear element; only structures that have
/// it make one of these.
class TensionBars {
 public:
  /// Null if no rank has a tension-only bar in this structure. Collective.
  static std::unique_ptr<TensionBars> build(const Structure& structure, const Mesh& mesh);

  /// force += internal force [N] of the bars on owned dofs; `w` over owned dofs. Collective.
  void add_force(const double* w, double* force);
  GlobalIndex count() const { return count_; }

 private:
  struct Bar {
    std::array<LocalIndex, 6> dofs{};  ///< owned: local dof; ghost: owned dofs + place; -1: clamped
    Vector3 axis{0, 0, 0};
    double stiffness = 0;  ///< E A / L [N/m]
  };
  TensionBars() = default;

  LocalIndex owned_dofs_ = 0;
  GlobalIndex count_ = 0;
  std::unique_ptr<Halo> halo_;
  std::vector<Bar> bars_;
};

}  // namespace pounding
