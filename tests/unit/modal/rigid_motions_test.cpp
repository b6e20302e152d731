#include <cmath>

#include <gtest/gtest.h>

#include "modal/modal_analysis.h"
#include "reduced_box.h"

namespace pounding {
namespace rigid_motions_test {

/// e_axis, or e_axis x r.
Vector3 rigid_motion(std::size_t motion, const Vector3& r) {
  Vector3 u{0, 0, 0};
  if (motion < 3) {
    u[motion] = 1;
  } else {
    const std::size_t axis = motion - 3;
    u[(axis + 1) % 3] = -r[(axis + 2) % 3];
    u[(axis + 2) % 3] = r[(axis + 1) % 3];
  }
  return u;
}

TEST(RigidMotions, AreThoseOfABrickAboutItsCentre) {
  // 2 m x 1 m x 0.5 m of concrete, cells of 0.5 m x 1/3 m x 0.25 m.
  const testing_support::ReducedBox box(false);
  const RigidMotions motions(box.system, box.mesh);
  const double mass = 2400 * 2 * 1 * 0.5;
  EXPECT_NEAR(motions.mass(), mass, 1e-9 * mass);
  const Vector3 centre{1, 0.5, 0.25};
  const Vector3 length{2, 1, 0.5};
  const Vector3 cell{0.5, 1.0 / 3, 0.25};
  Vector3 square{0, 0, 0};  // lumped masses lie farther out than those of the brick
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(motions.centre()[d], centre[d], 1e-12);
    square[d] = mass * (length[d] * length[d] / 12 + cell[d] * cell[d] / 6);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const double inertia = k < 3 ? mass : square[(k + 1) % 3] + square[(k + 2) % 3];
    EXPECT_NEAR(motions.inertia()[k], inertia, 1e-9 * mass);
    std::vector<double> y(box.system.lumped_mass.size(), 0.0);
    for (LocalIndex node = 0; node < box.mesh.owned_nodes; ++node) {
      const Vector3 x = box.mesh.position(node);
      const Vector3 u = rigid_motion(k, {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]});
      for (int c = 0; c < 3; ++c) {
        const auto dof = static_cast<std::size_t>(box.mesh.dof(node, c));
        y[dof] = std::sqrt(box.system.lumped_mass[dof]) * u[static_cast<std::size_t>(c)];
      }
    }
    const std::array<double, 6> participation = motions.participation(y.data());
    for (std::size_t other = 0; other < 6; ++other) {
      EXPECT_NEAR(participation[other], other == k ? inertia : 0, 1e-9 * mass);
    }
  }
}

}  // namespace rigid_motions_test
}  // namespace pounding
