#include "dynamics/state.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/petsc.h"
#include "dynamics/cd_lagrange.h"
#include "stability/stable_time_step.h"
#include "support/mast.h"

namespace pounding {
namespace state_test {

using testing_support::build_mast;
using testing_support::Mast;

TEST(State, StartsWithOneDisplacementAndVelocityOfAllTranslations) {
  const Mast mast = build_mast({0.1, -0.2, 0.3}, {4, 5, 6});
  const testing_support::BuiltSystem& built = mast.built;
  const State state({&built.system, 1});
  ASSERT_EQ(state.structures.size(), 1U);
  const StructureState& body = state.structures[0];
  for (LocalIndex node = 0; node < built.mesh.owned_nodes; ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = built.mesh.dof(node, c);
      if (dof < 0) continue;
      const auto i = static_cast<std::size_t>(c);
      EXPECT_EQ(body.displacement[static_cast<std::size_t>(dof)],
                c < 3 ? mast.structure.initial_displacement[i] : 0);
      EXPECT_EQ(body.velocity[static_cast<std::size_t>(dof)],
                c < 3 ? mast.structure.initial_velocity[i] : 0);
    }
  }
}

TEST(StateVectors, GivePetscWhatTheStepLeftInTheArrays) {
  const Mast mast = build_mast({0, 0, 0}, {0.2, -0.1, 0});
  const LinearSystem& system = mast.built.system;
  const GroundMotion still({}, Resampling::linear);
  Profile profile;
  const double time_step = 0.5 * stable_time_step(Rayleigh{}, system.element_frequency_bound);
  CdLagrange stepper(PETSC_COMM_WORLD, {&system, 1}, still, time_step, profile);
  double last = 0;
  for (int n = 0; n < 5; ++n) {
    stepper.step(false, false);
    const StructureState& state = stepper.state().structures[0];
    double square = 0;
    for (const double u : state.displacement) square += u * u;
    MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    // PETSc keeps norms: the next one must be that of the new values.
    double norm = 0;
    POUNDING_PETSC(VecNorm(stepper.vectors(0).displacement(), NORM_2, &norm));
    EXPECT_NEAR(norm, std::sqrt(square), 1e-14 * norm);
    EXPECT_GT(norm, last);
    last = norm;
    PetscInt size = 0, local = 0;
    POUNDING_PETSC(VecGetSize(stepper.vectors(0).velocity(), &size));
    POUNDING_PETSC(VecGetLocalSize(stepper.vectors(0).velocity(), &local));
    EXPECT_EQ(size, mast.built.mesh.global_dofs);
    EXPECT_EQ(local, mast.built.mesh.owned_dofs);
    const VecReader velocity(stepper.vectors(0).velocity());
    EXPECT_EQ(velocity.data(), state.velocity.data());  // no copy
  }
}

}  // namespace state_test
}  // namespace pounding
