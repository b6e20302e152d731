#include "system/coupled_mass.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "modal/modal_analysis.h"
#include "stability/stable_time_step.h"
#include "support/built_system.h"
#include "support/dense_damping.h"
#include "support/scaled_structure.h"

namespace pounding {
namespace coupled_mass_test {

using testing_support::build_system;
using testing_support::BuiltSystem;
using testing_support::DampedStructure;
using testing_support::dense_mass;
using testing_support::DenseSystem;
using testing_support::scaled_structure;

/// The dt at which the largest eigenvalue of (M + S)^-1 (2 dt C + dt^2 K) is 4, the mass term of C
/// with M + S if `safe`.
double dense_limit(const DampedStructure& damped, const DenseSystem& dense, bool safe) {
  const std::size_t n = dense.mass.size();
  const std::vector<double> mass = dense_mass(damped, dense);
  double low = 1e-12;
  double high = 1e3;
  for (int i = 0; i < 120 && high > low * (1 + 1e-12); ++i) {
    const double dt = std::sqrt(low * high);
    std::vector<double> growth(n * n);
    for (std::size_t k = 0; k < n * n; ++k) {
      growth[k] = 2 * dt * dense.damping[k] + dt * dt * dense.stiffness[k];
      const double diagonal = k % (n + 1) == 0 ? dense.mass[k / n] : 0;
      growth[k] += safe ? 2 * dt * damped.structure.damping.alpha * (mass[k] - diagonal) : 0;
    }
    (testing_support::generalized_eigenvalues(growth, mass, n).back() < 4 ? low : high) = dt;
  }
  return low;
}

TEST(CoupledMass, LivesOnOneRankGroupByGroup) {
  const DampedStructure damped = scaled_structure(1);
  const BuiltSystem built = build_system(damped.mesh, damped.structure);
  const MassScaling& scaling = built.system.mass_scaling;
  EXPECT_EQ(scaling.elements, 4 + 2 + 5 + 9);  // springs, bars and 9 of the 12 bricks
  EXPECT_EQ(scaling.time_step, damped.structure.mass_scaling);
  GlobalIndex here = 0;
  for (std::size_t n = 0;
       built.system.coupled_mass && n < built.system.coupled_mass->nodes().size(); ++n) {
    here += built.system.coupled_mass->nodes()[n].count;
  }
  MPI_Allreduce(MPI_IN_PLACE, &here, 1, MPI_INT64_T, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_EQ(here, scaling.dofs);
  EXPECT_EQ(scaling.dofs % 3, 0);
}

TEST(CoupledMass, ModesAreThoseOfTheDenseMatrices) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const DampedStructure damped = scaled_structure(seed);
    const BuiltSystem built = build_system(damped.mesh, damped.structure);
    const DenseSystem dense = testing_support::dense_system(damped);
    const auto squares = testing_support::generalized_eigenvalues(
        dense.stiffness, dense_mass(damped, dense), dense.mass.size());
    const ModalResult modes = lowest_modes(built.system, built.mesh, 5);
    for (std::size_t i = 0; i < 5; ++i) {
      const double expected = std::sqrt(squares[i]) / (2 * 3.14159265358979323846);
      EXPECT_NEAR(modes.modes[i].frequency / expected, 1, 1e-7) << seed << " " << i;
    }
    const double largest = largest_frequency(built.system, built.mesh).omega_max;
    EXPECT_NEAR(largest / std::sqrt(squares.back()), 1, 1e-9) << seed;
    EXPECT_LE(largest, built.system.element_frequency_bound * (1 + 1e-9)) << seed;
  }
}

TEST(CoupledMass, StabilityLimitIsThatOfTheDenseMatrices) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const DampedStructure damped = scaled_structure(seed);
    const BuiltSystem built = build_system(damped.mesh, damped.structure);
    const DenseSystem dense = testing_support::dense_system(damped);
    const double limit = stability_limit(built.system, built.mesh);
    EXPECT_NEAR(limit / dense_limit(damped, dense, true), 1, 1e-9) << seed;
    EXPECT_LE(limit, dense_limit(damped, dense, false) * (1 + 1e-9)) << seed;
    EXPECT_LE(built.system.element_time_step_bound, limit * (1 + 1e-9)) << seed;
  }
}

}  // namespace coupled_mass_test
}  // namespace pounding
