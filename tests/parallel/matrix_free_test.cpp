#include <gtest/gtest.h>

#include "modal/eigen_solver.h"
#include "modal/modal_analysis.h"
#include "stability/stable_time_step.h"
#include "support/box_mesh.h"
#include "support/built_stiffness.h"
#include "support/dense_damping.h"

namespace pounding {
namespace matrix_free_test {

using testing_support::build_system;
using testing_support::BuiltSystem;

/// The structure with products by elements, and with an assembled matrix.
struct Pair {
  BuiltSystem by_element;
  BuiltSystem assembled;
};

Pair build_pair(const GlobalMesh& mesh, const Structure& structure, bool with_matrix = false) {
  Pair pair{build_system(mesh, structure), build_system(mesh, structure)};
  pair.by_element.system = pounding::build_system(structure, pair.by_element.mesh,
                                                  StiffnessMethod::element, with_matrix);
  return pair;
}

GlobalMesh clamped_block() {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2, 1.1, 0.9}, {7, 4, 3});
  testing_support::clamp(mesh, "x_min");
  return mesh;
}

TEST(MatrixFree, LargestFrequencyIsThatOfTheMatrix) {
  const auto [free, assembled] =
      build_pair(clamped_block(), testing_support::solid_structure("block", 30e9, 0.2, 2400));
  EXPECT_EQ(free.system.stiffest_matrix(), nullptr);
  const LargestFrequency found = largest_frequency(free.system, free.mesh);
  const LargestFrequency expected = largest_frequency(assembled.system, assembled.mesh);
  EXPECT_NEAR(found.omega_max / expected.omega_max, 1, 1e-9);
  EXPECT_EQ(found.location, expected.location);
}

TEST(MatrixFree, StabilityLimitIsThatOfTheMatrices) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const testing_support::DampedStructure damped = testing_support::random_structure(seed);
    const auto [free, assembled] = build_pair(damped.mesh, damped.structure);
    EXPECT_EQ(free.system.stiffest_matrix(), nullptr);
    const double limit = stability_limit(assembled.system, assembled.mesh);
    EXPECT_NEAR(stability_limit(free.system, free.mesh) / limit, 1, 1e-9);
    EXPECT_NEAR(smallest_energy_margin(free.system, free.mesh, 0.7 * limit),
                smallest_energy_margin(assembled.system, assembled.mesh, 0.7 * limit), 1e-9);
  }
}

TEST(MatrixFree, ModesAskForTheMatrixAndGiveItBack) {
  const auto [free, assembled] =
      build_pair(clamped_block(), testing_support::solid_structure("block", 30e9, 0.2, 2400),
                 /*with_matrix=*/true);
  ASSERT_NE(free.system.stiffest_matrix(), nullptr);
  const auto found = lowest_modes(free.system, free.mesh, 6).modes;
  const auto expected = lowest_modes(assembled.system, assembled.mesh, 6).modes;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(found[i].frequency / expected[i].frequency, 1, 1e-9);
  }
  free.system.stiffness->release_matrix();
  EXPECT_EQ(free.system.stiffest_matrix(), nullptr);
  assembled.system.stiffness->release_matrix();
  EXPECT_NE(assembled.system.stiffest_matrix(), nullptr);  // its products need it
}

/// y^T A y. Collective.
double quotient_of(const ScaledOperator& a, const LinearSystem& system, std::vector<double>& y) {
  const VecHandle vector = wrap_vector(system, y);
  std::vector<double> image(y.size());
  const VecHandle product = wrap_vector(system, image);
  double value = 0;
  a.apply(vector.get(), product.get());
  POUNDING_PETSC(VecDot(vector.get(), product.get(), &value));
  return value;
}

/// A = M^-1/2 (2 K + 3 K) M^-1/2 + 7 I against PETSc's scaled matrix.
TEST(MatrixFree, ScaledOperatorSumsItsTerms) {
  BuiltSystem built =
      build_system(clamped_block(), testing_support::solid_structure("block", 30e9, 0.2, 2400));
  const stiffness::Stiffness& stiffness = built.system.stiffest();
  const ScaledOperator found(built.system, {{2, &stiffness}, {3, &stiffness}}, 7);
  const ScaledOperator once(built.system, {{1, &stiffness}});
  std::vector<double> x = testing_support::random_field(built.mesh, 3);
  double square = 0;
  for (const double value : x) square += value * value;
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, built.mesh.comm);
  std::vector<double> y = x;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] *= std::sqrt(built.system.inverse_mass[i]);
  std::vector<double> force(y.size());
  const VecHandle argument = wrap_vector(built.system, y);
  const VecHandle product = wrap_vector(built.system, force);
  POUNDING_PETSC(MatMult(built.system.stiffest_matrix(), argument.get(), product.get()));
  double quotient = 0;
  POUNDING_PETSC(VecDot(argument.get(), product.get(), &quotient));
  EXPECT_NEAR(quotient_of(once, built.system, x) / quotient, 1, 1e-12);
  EXPECT_NEAR(quotient_of(found, built.system, x) / (5 * quotient + 7 * square), 1, 1e-12);
}

}  // namespace matrix_free_test
}  // namespace pounding
