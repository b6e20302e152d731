#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"
#include "system/linear_system.h"

namespace pounding {

/// Rigid-body motions of the free nodes: along x, y, z, and about them through the centre of mass.
class RigidMotions {
 public:
  /// Collective over the system's communicator. `system` must outlive this object.
  RigidMotions(const LinearSystem& system, const Mesh& mesh);

  double mass() const { return mass_; }  ///< of the free dofs [kg]
  const Vector3& centre() const { return centre_; }
  /// R^T M R of each motion R [kg, kg m2].
  const std::array<double, 6>& inertia() const { return inertia_; }
  /// R^T M^1/2 y of each motion for y over the owned dofs; y = M^1/2 phi gives the participation
  /// factors of a mode. Collective.
  std::array<double, 6> participation(const double* y) const;

 private:
  /// a^T M a on this rank.
  double weighted_square(const std::vector<double>& a) const;

  const LinearSystem& system_;
  double mass_ = 0;
  Vector3 centre_{0, 0, 0};
  std::array<std::vector<double>, 6> motions_;
  std::array<double, 6> inertia_{};
};

}  // namespace pounding
