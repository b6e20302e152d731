#include "system/coupled_mass.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "modal/modal_analysis.h"
#include "modal/stability_limit.h"
#include "support/built_system.h"
#include "support/dense_damping.h"

namespace pounding {
namespace {

using testing::build_system;
using testing::BuiltSystem;
using testing::DampedStructure;
using testing::DenseSystem;

/// Bricks on springs with dashpots, and a chain of stiff bars along the lower edges of the body,
/// all of whose springs and bars have their mass scaled.
DampedStructure scaled_structure(unsigned seed) {
  DampedStructure damped = testing::random_structure(seed);
  Region& ties = testing::add_region(damped, "ties", ElementType::bar, {0, 1, 1, 2, 2, 3, 3, 7});
  ties.material = {"steel", 2e11, 0.3, 100};
  ties.area = 0.01;
  const BuiltSystem plain = build_system(damped.mesh, damped.structure);
  damped.structure.mass_scaling = 2 * stability_limit(plain.system, plain.mesh);
  return damped;
}

/// M + S over all dofs.
std::vector<double> dense_mass(const DampedStructure& damped, const DenseSystem& dense) {
  const std::size_t n = dense.mass.size();
  std::vector<double> mass(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    mass[i * n + i] = dense.mass[i];
  }
  for (const ElementSet& set : damped.mesh.regions) {
    const Region& region = damped.structure.regions[static_cast<std::size_t>(set.region)];
    const auto nodes = static_cast<std::size_t>(element_layout(set.type).nodes);
    const std::size_t size = 3 * nodes;
    for (std::size_t e = 0; may_be_scaled(set.type) && e < set.tags.size(); ++e) {
      std::vector<double> x, k(size * size), m(size), d(size * size), added(size * size);
      std::vector<std::size_t> dofs;
      for (std::size_t a = 0; a < nodes; ++a) {
        const GlobalIndex node = set.connectivity[e * nodes + a];
        const Vector3 position = damped.mesh.position(node);
        x.insert(x.end(), position.begin(), position.end());
        for (int c = 0; c < 3; ++c) {
          const auto found = dense.dof.find({node, c});
          dofs.push_back(found == dense.dof.end() ? n : found->second);
        }
      }
      element_matrices(set.type, x, element_properties(region), k, m);
      element_dashpots(set.type, element_properties(region), d);
      add_element_mass(damped.structure.mass_scaling, damped.structure.damping_of(region), k, m, d,
                       added);
      for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < size; ++j) {
          if (dofs[i] < n && dofs[j] < n) mass[dofs[i] * n + dofs[j]] += added[i * size + j];
        }
      }
    }
  }
  return mass;
}

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
  EXPECT_EQ(scaling.elements, 4 + 2 + 5);
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
    const DenseSystem dense = testing::dense_system(damped);
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
    const DenseSystem dense = testing::dense_system(damped);
    const double limit = stability_limit(built.system, built.mesh);
    EXPECT_NEAR(limit / dense_limit(damped, dense, true), 1, 1e-9) << seed;
    EXPECT_LE(limit, dense_limit(damped, dense, false) * (1 + 1e-9)) << seed;
    EXPECT_LE(built.system.element_time_step_bound, limit * (1 + 1e-9)) << seed;
  }
}

}  // namespace
}  // namespace pounding
