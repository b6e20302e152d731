#include "modal/lanczos.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/dense_matrix.h"
#include "modal/modal_analysis.h"
#include "stability/stable_time_step.h"
#include "support/box_mesh.h"
#include "support/built_system.h"
#include "support/frame_mesh.h"

namespace pounding {
namespace lanczos_test {

using testing_support::BuiltSystem;

constexpr double young = 200e9;
constexpr double density = 7800;
const EigenvalueEffort least{1e-3, 0};

/// Largest eigenvalue of the whole model's dense matrices.
double dense_largest(const GlobalMesh& global, const Structure& structure) {
  const Partition whole = partition_meshes({&global, 1}, {}, 1, {}, {});
  BuiltSystem built = testing_support::build_system(PETSC_COMM_SELF, global, structure, whole);
  const std::size_t n = built.system.lumped_mass.size();
  std::vector<double> stiffness(n * n);
  std::vector<double> unit(n, 0.0);
  std::vector<double> force(n);
  const VecHandle argument = wrap_vector(built.system, unit);
  const VecHandle column = wrap_vector(built.system, force);
  for (std::size_t j = 0; j < n; ++j) {
    POUNDING_PETSC(VecSet(argument.get(), 0));
    POUNDING_PETSC(VecSetValue(argument.get(), static_cast<PetscInt>(j), 1, INSERT_VALUES));
    POUNDING_PETSC(VecAssemblyBegin(argument.get()));
    POUNDING_PETSC(VecAssemblyEnd(argument.get()));
    built.system.stiffness->apply(argument.get(), column.get());
    for (std::size_t i = 0; i < n; ++i) stiffness[i * n + j] = force[i];
  }
  return largest_eigenvalue(stiffness, built.system.lumped_mass);
}

void expect_bounds(const GlobalMesh& mesh, const Structure& structure, const char* what) {
  const double omega = std::sqrt(dense_largest(mesh, structure));
  const BuiltSystem built = testing_support::build_system(mesh, structure);
  const double found = largest_frequency(built.system, built.mesh).omega_max;
  EXPECT_NEAR(found / omega, 1, 1e-9) << what;
  EXPECT_GE(found, omega * (1 - 1e-12)) << what;
  for (const double tolerance : {0.1, 0.03, 1e-3}) {
    const LargestFrequency quick =
        largest_frequency(built.system, built.mesh, {tolerance, /*work=*/0});
    EXPECT_GE(quick.omega_max, omega * (1 - 1e-12)) << what << tolerance;
    EXPECT_LE(quick.omega_max, omega * (1 + 1.2 * tolerance)) << what << tolerance;
  }
}

TEST(Lanczos, BoundsTheLargestFrequencyOfBricks) {
  const GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2, 1.1, 0.9}, {6, 4, 2});
  expect_bounds(mesh, testing_support::solid_structure("block", young, 0.2, density), "bricks");
}

TEST(Lanczos, BoundsTheLargestFrequencyOfShellsAndBeams) {
  testing_support::FrameMesh plate;
  plate.add_plate({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {6, 6}, 0.2);
  expect_bounds(plate.mesh(), plate.structure(), "plate");
  testing_support::FrameMesh table;
  table.add_plate({0, 0, 3}, {3, 0, 0}, {0, 3, 0}, {3, 3}, 0.2);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}, {0.0, 3.0}}) {
    table.add_beams({x, y, 0}, {x, y, 3}, 4, {1, 0, 0});
    table.clamp({x, y, 0});
  }
  expect_bounds(table.mesh(), table.structure(), "table");
}

/// Bars of unit length one behind another, free along x only; the one in the middle is stiffer by a
/// part `defect`, and those before it are damped otherwise.
struct Chain {
  GlobalMesh mesh;
  Structure structure;
};

Chain chain(int bars, double defect, double beta = 0) {
  Chain result;
  result.structure.name = "chain";
  for (int node = 0; node <= bars; ++node) {
    result.mesh.node_tags.push_back(node + 1);
    result.mesh.coordinates.insert(result.mesh.coordinates.end(), {1.0 * node, 0.0, 0.0});
  }
  result.mesh.components.assign(result.mesh.node_tags.size(), 0x07);
  result.mesh.free_components.assign(result.mesh.node_tags.size(), 0x01);
  const int middle = bars / 2;
  std::int64_t tag = 0;
  const auto add = [&](const char* group, int first, int last, double stiffer) {
    Region region;
    region.group = group;
    region.element = ElementType::bar;
    region.material = {group, young * stiffer, 0.3, density};
    region.area = 1;
    ElementSet set;
    set.group = group;
    set.region = static_cast<int>(result.structure.regions.size());
    set.type = region.element;
    for (int bar = first; bar < last; ++bar) {
      set.tags.push_back(++tag);
      set.connectivity.insert(set.connectivity.end(), {bar, bar + 1});
    }
    result.structure.regions.push_back(region);
    result.mesh.regions.push_back(set);
  };
  add("before", 0, middle, 1);
  add("stiff", middle, middle + 1, 1 + defect);
  add("behind", middle + 1, bars, 1);
  if (beta > 0) result.structure.regions[0].damping = Rayleigh{0, beta};
  return result;
}

/// A free chain has 2 c / h exactly; its highest frequencies lie so close to each other that a bound
/// is all that a few hundred products give.
TEST(Lanczos, BoundsCrowdedFrequenciesClosely) {
  const Chain bars = chain(4000, 0);
  const BuiltSystem built = testing_support::build_system(bars.mesh, bars.structure);
  const double omega = 2 * std::sqrt(young / density);
  const LargestFrequency quick = largest_frequency(built.system, built.mesh, least);
  EXPECT_GT(quick.excess, 0);
  EXPECT_LE(quick.excess, 1.0001e-3);
  EXPECT_LT(quick.products, 500);
  EXPECT_GE(quick.omega_max, omega);
  EXPECT_LE(quick.omega_max, omega * (1 + 1.01e-3));
}

/// One spring k (1 + d) among many k has a mode of its own, mass m omega^2 = k (2 + r + 1 / r) with
/// 1 / r = 1 + 2 d: 0.8 % above the next ones for d = 0.1, and of a few nodes among thousands.
TEST(Lanczos, FindsOneStiffElementAmongThousands) {
  const Chain bars = chain(4000, 0.1);
  const BuiltSystem built = testing_support::build_system(bars.mesh, bars.structure);
  const double r = 1 / 1.2;
  const double omega = std::sqrt(young / density * (2 + r + 1 / r));
  for (const EigenvalueEffort& effort : {EigenvalueEffort{}, least}) {
    const LargestFrequency found = largest_frequency(built.system, built.mesh, effort);
    EXPECT_GE(found.omega_max, omega * (1 - 1e-12));
    EXPECT_LE(found.omega_max, omega * (1 + effort.tolerance));
    EXPECT_NE(found.location.find("(2000, 0, 0)") == std::string::npos,
              found.location.find("(2001, 0, 0)") == std::string::npos)
        << found.location;
  }
  EXPECT_NEAR(largest_frequency(built.system, built.mesh).omega_max / omega, 1, 1e-9);
}

TEST(Lanczos, StableStepOfAnyDampingIsOnTheSafeSideByTheTolerance) {
  const Chain bars = chain(700, 0, 1e-4);
  const BuiltSystem built = testing_support::build_system(bars.mesh, bars.structure);
  ASSERT_TRUE(built.system.extra_damping);
  const double exact = stability_limit(built.system, built.mesh);
  const double quick = stability_limit(built.system, built.mesh, least);
  EXPECT_LE(quick, exact);
  EXPECT_GE(quick, exact * (1 - 2.1e-3));
  EXPECT_LT(quick, exact * (1 - 1e-5));  // it did stop early
  const double margin = smallest_energy_margin(built.system, built.mesh, 0.9 * exact);
  const double quick_margin = smallest_energy_margin(built.system, built.mesh, 0.9 * exact, least);
  EXPECT_LE(quick_margin, margin);
  EXPECT_GE(quick_margin, margin - 2.1e-3);
}

TEST(Lanczos, MissesLessWithEveryProduct) {
  EXPECT_EQ(Lanczos::missed(1000000, 1), 1);
  for (int k = 20; k < 1000; k *= 2) {
    EXPECT_LT(Lanczos::missed(1000000, 2 * k), Lanczos::missed(1000000, k) / 3.9);
    EXPECT_GT(Lanczos::missed(1000000, k), Lanczos::missed(1000, k));
  }
  // 1.648 sqrt(n) exp(-sqrt(e) (2 k - 1)) = 1e-9
  const double e = Lanczos::missed(1000000, 315);
  EXPECT_NEAR(1.648 * 1000 * std::exp(-std::sqrt(e) * 629) / 1e-9, 1, 1e-9);
}

}  // namespace lanczos_test
}  // namespace pounding
