#include <cmath>

#include <gtest/gtest.h>

#include "modal/eigen_solver.h"
#include "modal/modal_analysis.h"
#include "support/box_mesh.h"
#include "support/built_system.h"

namespace pounding {
namespace lowest_iteration_test {

using testing_support::build_system;
using testing_support::BuiltSystem;

GlobalMesh tower(bool clamped) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2, 2.3, 6}, {6, 6, 14});
  if (clamped) testing_support::clamp(mesh, "z_min");
  return mesh;
}

BuiltSystem built_tower(bool clamped) {
  return build_system(tower(clamped), testing_support::solid_structure("tower", 30e9, 0.2, 2400));
}

double dot(MPI_Comm comm, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return sum;
}

void expect_same_modes(const BuiltSystem& built, int count, double tolerance) {
  const ModalResult direct =
      lowest_modes(built.system, built.mesh, count, false, SolverChoice::direct);
  const ModalResult iterated =
      lowest_modes(built.system, built.mesh, count, true, SolverChoice::iterative);
  EXPECT_EQ(direct.method, "");
  EXPECT_NE(iterated.method.find("multigrid"), std::string::npos) << iterated.method;
  ASSERT_EQ(iterated.modes.size(), direct.modes.size());
  for (std::size_t i = 0; i < direct.modes.size(); ++i) {
    const Mode& mode = iterated.modes[i];
    const double scale = std::max(direct.modes[i].frequency, 1.0);
    EXPECT_NEAR(mode.frequency, direct.modes[i].frequency, tolerance * scale) << i;
    std::vector<double> momentum = mode.shape;
    for (std::size_t k = 0; k < momentum.size(); ++k) momentum[k] *= built.system.lumped_mass[k];
    for (std::size_t j = 0; j <= i; ++j) {
      EXPECT_NEAR(dot(built.system.comm, momentum, iterated.modes[j].shape), i == j ? 1 : 0, 1e-6)
          << i << " " << j;
    }
  }
}

TEST(LowestIteration, FindsTheModesOfTheFactorisation) {
  expect_same_modes(built_tower(true), 12, 1e-8);
}

TEST(LowestIteration, FindsRigidMotionsOfAFreeBody) {
  const BuiltSystem built = built_tower(false);
  expect_same_modes(built, 10, 1e-3);
  const ModalResult result =
      lowest_modes(built.system, built.mesh, 10, false, SolverChoice::iterative);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(result.modes[i].frequency, 0.01) << i;
    EXPECT_FALSE(result.modes[i].location.empty()) << i;
  }
  EXPECT_TRUE(result.modes[6].location.empty());
}

/// A square section: bending modes come in equal pairs, of which none may be missed.
TEST(LowestIteration, FindsBothOfEqualFrequencies) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {1, 1, 6}, {4, 4, 20});
  testing_support::clamp(mesh, "z_min");
  const BuiltSystem built =
      build_system(mesh, testing_support::solid_structure("mast", 30e9, 0.2, 2400));
  const auto modes =
      lowest_modes(built.system, built.mesh, 4, false, SolverChoice::iterative).modes;
  EXPECT_NEAR(modes[1].frequency / modes[0].frequency, 1, 1e-8);
  EXPECT_GT(modes[2].frequency, 1.5 * modes[0].frequency);
}

TEST(LowestIteration, IsNotTakenWhereTheFactorFits) {
  const BuiltSystem built = built_tower(true);
  EXPECT_FALSE(must_iterate(built.system, built.system.stiffest_matrix(), SolverChoice::automatic));
  EXPECT_TRUE(must_iterate(built.system, built.system.stiffest_matrix(), SolverChoice::iterative));
}

}  // namespace lowest_iteration_test
}  // namespace pounding
