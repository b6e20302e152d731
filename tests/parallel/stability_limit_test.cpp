#include <cmath>

#include <gtest/gtest.h>

#include "modal/modal_analysis.h"
#include "stability/stable_time_step.h"
#include "support/built_system.h"
#include "support/dense_damping.h"

namespace pounding {
namespace stability_limit_test {

using testing_support::build_system;
using testing_support::BuiltSystem;
using testing_support::DampedStructure;
using testing_support::dense_system;
using testing_support::DenseSystem;
using testing_support::random_structure;

constexpr unsigned structures = 8;

/// One mass of 8 kg, free, with a rate of damping by its mass [1/s], beside a spring and a strong
/// dashpot to the ground along x.
DampedStructure oscillator(double stiffness, double rate) {
  DampedStructure damped;
  damped.structure.name = "oscillator";
  damped.mesh.node_tags = {1};
  damped.mesh.coordinates = {0, 0, 0};
  damped.mesh.components = {0x07};
  damped.mesh.free_components = damped.mesh.components;
  Region& mass = testing_support::add_region(damped, "mass", ElementType::point_mass, {0});
  mass.mass = 8;
  mass.damping = Rayleigh{rate, 0};
  Region& support =
      testing_support::add_region(damped, "support", ElementType::grounded_spring, {0});
  support.stiffness = {stiffness};
  support.dashpot = {1e9};
  return damped;
}

TEST(StabilityLimit, IsThatOfTheDenseMatrices) {
  for (unsigned seed = 0; seed < structures; ++seed) {
    const DampedStructure damped = random_structure(seed);
    const BuiltSystem built = build_system(damped.mesh, damped.structure);
    ASSERT_TRUE(built.system.extra_damping);
    const double expected = testing_support::dense_stability_limit(dense_system(damped));
    const double limit = stability_limit(built.system, built.mesh);
    EXPECT_NEAR(limit / expected, 1, 1e-9) << seed;
    EXPECT_LE(limit, expected * (1 + 1e-12)) << seed;
  }
}

TEST(StabilityLimit, LiesBetweenTheBoundOfTheElementsAndTheUndampedOne) {
  for (unsigned seed = 0; seed < structures; ++seed) {
    const DampedStructure damped = random_structure(seed);
    const BuiltSystem built = build_system(damped.mesh, damped.structure);
    const double limit = stability_limit(built.system, built.mesh);
    const double undamped = 2 / largest_frequency(built.system, built.mesh).omega_max;
    EXPECT_LE(built.system.element_time_step_bound, limit) << seed;
    EXPECT_GT(built.system.element_time_step_bound, 0.1 * limit) << seed;
    EXPECT_LT(limit, undamped) << seed;
  }
}

TEST(StabilityLimit, MarginIsThatOfTheDenseMatrices) {
  const DampedStructure damped = random_structure(1);
  const BuiltSystem built = build_system(damped.mesh, damped.structure);
  const DenseSystem dense = dense_system(damped);
  const double limit = stability_limit(built.system, built.mesh);
  for (const double part : {0.3, 0.9, 0.999, 1.1}) {
    const double margin = smallest_energy_margin(built.system, built.mesh, part * limit);
    EXPECT_NEAR(margin, 1 - testing_support::largest_growth(dense, part * limit) / 4, 1e-9) << part;
    EXPECT_EQ(margin > 0, part < 1) << part;
  }
}

TEST(StabilityLimit, OfRayleighDampingIsEquation12) {
  DampedStructure damped = random_structure(2);
  for (Region& region : damped.structure.regions) {
    region.damping = damped.structure.damping;
  }
  const BuiltSystem built = build_system(damped.mesh, damped.structure);
  EXPECT_FALSE(built.system.extra_damping);
  const double omega = largest_frequency(built.system, built.mesh).omega_max;
  EXPECT_NEAR(
      stability_limit(built.system, built.mesh) / stable_time_step(damped.structure.damping, omega),
      1, 1e-9);
}

TEST(StabilityLimit, OfOneMassIsAClosedForm) {
  const double mass = 8;
  for (const auto& [k, rate] : {std::pair{3e4, 9.0}, {3e4, 1.2e4}, {0.0, 1.5}}) {
    const DampedStructure damped = oscillator(k, rate);
    const BuiltSystem built = build_system(damped.mesh, damped.structure);
    const double expected = 2 / (rate / 2 + std::sqrt(rate * rate / 4 + k / mass));
    EXPECT_NEAR(stability_limit(built.system, built.mesh) / expected, 1, 1e-9) << k << ' ' << rate;
    EXPECT_NEAR(built.system.element_time_step_bound / expected, 1, 1e-12) << k << ' ' << rate;
  }
  const DampedStructure damped = oscillator(0, 0);
  const BuiltSystem built = build_system(damped.mesh, damped.structure);
  EXPECT_TRUE(std::isinf(stability_limit(built.system, built.mesh)));
}

/// D v of a vector that differs from dof to dof.
TEST(ExtraDamping, IsWhatTheStructuresAlphaAndBetaDoNotTell) {
  for (unsigned seed = 0; seed < structures; ++seed) {
    const DampedStructure damped = random_structure(seed);
    const DenseSystem dense = dense_system(damped);
    BuiltSystem built = build_system(damped.mesh, damped.structure);
    const std::size_t n = dense.mass.size();
    std::vector<double> all(n);
    for (std::size_t j = 0; j < n; ++j) {
      all[j] = std::cos(0.7 * static_cast<double>(j));
    }
    std::vector<double> v(built.system.lumped_mass.size());
    std::vector<double> force(v.size());
    const auto visit = [&](auto&& use) {
      for (LocalIndex node = 0; node < built.mesh.owned_nodes; ++node) {
        const GlobalIndex number = built.mesh.file_node[static_cast<std::size_t>(node)];
        for (int c = 0; c < 3; ++c) {
          const LocalIndex dof = built.mesh.dof(node, c);
          if (dof >= 0) use(static_cast<std::size_t>(dof), dense.dof.at({number, c}));
        }
      }
    };
    visit([&](std::size_t dof, std::size_t i) { v[dof] = all[i]; });
    const VecHandle argument = wrap_vector(built.system, v);
    const VecHandle result = wrap_vector(built.system, force);
    built.system.extra_damping->apply(argument.get(), result.get());
    const auto [alpha, beta] = damped.structure.damping;
    visit([&](std::size_t dof, std::size_t i) {
      double expected = -alpha * dense.mass[i] * all[i];
      double scale = std::abs(expected);
      for (std::size_t j = 0; j < n; ++j) {
        const double c = dense.damping[i * n + j];
        const double k = dense.stiffness[i * n + j];
        expected += (c - beta * k) * all[j];
        scale += std::abs(c * all[j]) + std::abs(beta * k * all[j]);
      }
      EXPECT_NEAR(force[dof], expected, 1e-12 * scale) << seed << ' ' << i;
    });
  }
}

}  // namespace stability_limit_test
}  // namespace pounding
