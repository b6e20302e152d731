#include "stability/energy_norm.h"

#include <cmath>

#include <gtest/gtest.h>

#include "stability/stable_time_step.h"
#include "support/built_system.h"
#include "support/dense_damping.h"
#include "support/scaled_structure.h"

namespace pounding {
namespace energy_norm_test {

using testing_support::BuiltSystem;
using testing_support::DampedStructure;
using testing_support::DenseSystem;

constexpr unsigned structures = 4;
constexpr double plenty = 1e9;

/// f^T A^-1 f with A = M + S - dt/2 C - dt^2/4 K, the mass term of C with M + S, from dense
/// matrices; `mass`: M + S.
double dense_square(const DampedStructure& damped, const DenseSystem& dense,
                    std::vector<double> mass, double dt, std::vector<double> f) {
  const std::size_t n = dense.mass.size();
  const double alpha = damped.structure.damping.alpha;
  std::vector<double> a(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double added = mass[i * n + j] - (i == j ? dense.mass[i] : 0);
      a[i * n + j] = mass[i * n + j] - dt / 2 * (dense.damping[i * n + j] + alpha * added) -
                     dt * dt / 4 * dense.stiffness[i * n + j];
    }
  }
  const std::vector<double> force = f;
  const int order = static_cast<int>(n);
  const int one = 1;
  int info = 0;
  dposv_("L", &order, &one, a.data(), &order, f.data(), &order, &info);
  EXPECT_EQ(info, 0);
  double square = 0;
  for (std::size_t i = 0; i < n; ++i) {
    square += force[i] * f[i];
  }
  return square;
}

/// A force at some dofs, the same for every partition.
std::vector<double> force_on(std::size_t dofs, std::size_t every) {
  std::vector<double> force(dofs, 0.0);
  for (std::size_t i = every / 2; i < dofs; i += every) {
    force[i] = 1 + std::cos(0.7 * static_cast<double>(i));
  }
  return force;
}

std::vector<double> owned_part(const BuiltSystem& built, const DenseSystem& dense,
                               const std::vector<double>& all) {
  std::vector<double> owned(built.system.lumped_mass.size(), 0.0);
  for (const auto& [place, i] : dense.dof) {
    const LocalIndex node = built.mesh.owned_node(place.first);
    const LocalIndex dof = node < 0 ? -1 : built.mesh.dof(node, place.second);
    if (dof >= 0) owned[static_cast<std::size_t>(dof)] = all[i];
  }
  return owned;
}

/// The bound and what it bounds, both of |f|.
struct Comparison {
  double bound = 0;
  double exact = 0;
};

Comparison compare(const DampedStructure& damped, double part_of_limit, std::size_t every,
                   double work) {
  const BuiltSystem built = testing_support::build_system(damped.mesh, damped.structure);
  const DenseSystem dense = testing_support::dense_system(damped);
  const double dt = part_of_limit * stability_limit(built.system, built.mesh);
  const double margin = smallest_energy_margin(built.system, built.mesh, dt);
  EnergyNorm norm(built.system, dt, margin, work);
  const std::vector<double> force = force_on(dense.mass.size(), every);
  return {norm.bound(owned_part(built, dense, force)),
          std::sqrt(
              dense_square(damped, dense, testing_support::dense_mass(damped, dense), dt, force))};
}

TEST(EnergyNorm, BoundsThatOfTheDenseMatricesClosely) {
  for (unsigned seed = 0; seed < structures; ++seed) {
    for (const bool scaled : {false, true}) {
      const DampedStructure damped = scaled ? testing_support::scaled_structure(seed)
                                            : testing_support::random_structure(seed);
      for (const double part : {0.5, 0.99, 0.9999}) {
        for (const std::size_t every : {1, 1000}) {
          const auto [bound, exact] = compare(damped, part, every, plenty);
          EXPECT_GE(bound, exact * (1 - 1e-12)) << seed << scaled << part << every;
          EXPECT_LE(bound, exact * 1.03) << seed << scaled << part << every;
        }
      }
    }
  }
}

TEST(EnergyNorm, IsABoundHoweverFewProductsItMayCost) {
  const DampedStructure damped = testing_support::random_structure(1);
  const auto dofs = static_cast<double>(testing_support::dense_system(damped).mass.size());
  double coarse = 0;  // without any
  for (const double products : {0.0, 2.0, 5.0, 20.0}) {
    const auto [bound, exact] = compare(damped, 0.999, 7, products * dofs);
    EXPECT_GE(bound, exact * (1 - 1e-12)) << products;
    coarse = products == 0 ? bound : coarse;
    EXPECT_LE(bound, coarse) << products;
    if (products == 20) {
      EXPECT_LT(bound, 0.5 * coarse);
    }
  }
}

TEST(EnergyNorm, IsNoCloserThanEnough) {
  const DampedStructure damped = testing_support::random_structure(1);
  const BuiltSystem built = testing_support::build_system(damped.mesh, damped.structure);
  const DenseSystem dense = testing_support::dense_system(damped);
  const double dt = 0.999 * stability_limit(built.system, built.mesh);
  const double margin = smallest_energy_margin(built.system, built.mesh, dt);
  const std::vector<double> force = owned_part(built, dense, force_on(dense.mass.size(), 7));
  const double closest = EnergyNorm(built.system, dt, margin, plenty).bound(force);
  const double coarsest = EnergyNorm(built.system, dt, margin, 0).bound(force);
  ASSERT_GT(coarsest, 3 * closest);
  for (const double enough : {1.5 * closest, 2.5 * closest}) {
    EnergyNorm norm(built.system, dt, margin, plenty);
    const double found = norm.bound(force, enough);
    EXPECT_LE(found, enough * (1 + 1e-5));
    EXPECT_GT(found, closest * 1.001);
  }
}

TEST(EnergyNorm, IsInfiniteWhereTheEnergyIsNoBound) {
  const DampedStructure damped = testing_support::random_structure(1);
  const BuiltSystem built = testing_support::build_system(damped.mesh, damped.structure);
  EnergyNorm norm(built.system, 1, -1e-3, plenty);
  EXPECT_TRUE(std::isinf(norm.bound(std::vector<double>(built.system.lumped_mass.size(), 1.0))));
}

}  // namespace energy_norm_test
}  // namespace pounding
