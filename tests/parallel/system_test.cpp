#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "common/error.h"
#include "common/parallel.h"
#include "modal/modal_analysis.h"
#include "support/box_mesh.h"
#include "support/built_system.h"
#include "support/refusal.h"
#include "system/finite_element_system.h"

namespace pounding {
namespace system_test {

constexpr double young = 30e9;
constexpr double density = 2400;

using Built = testing_support::BuiltSystem;
using testing_support::build_system;

TEST(System, EveryNodeAndElementIsOwnedOnce) {
  GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {4, 2, 1}, {8, 4, 2});
  testing_support::clamp(global, "x_min");
  const Built built =
      build_system(global, testing_support::solid_structure("box", young, 0.2, density));
  std::array<long, 4> counts{built.mesh.owned_nodes, built.mesh.owned_dofs, 0, 0};
  for (const ElementBlock& block : built.mesh.blocks) {
    for (const auto counted : block.counted) {
      counts[2] += counted;
    }
  }
  for (LocalIndex node = 0; node < built.mesh.owned_nodes; ++node) {
    counts[3] += built.mesh.file_node[static_cast<std::size_t>(node)];
  }
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), 4, MPI_LONG, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_EQ(counts[0], 9 * 5 * 3);
  EXPECT_EQ(counts[1], 3 * 8 * 5 * 3);
  EXPECT_EQ(counts[2], 8 * 4 * 2);
  EXPECT_EQ(counts[3], 135 * 134 / 2);
  EXPECT_EQ(built.mesh.global_dofs_unclamped, 3 * 135);
}

TEST(System, MassIsDensityTimesVolume) {
  GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {4, 2, 1}, {4, 3, 2});
  testing_support::clamp(global, "x_min");
  const Built built =
      build_system(global, testing_support::solid_structure("box", young, 0.2, density));
  EXPECT_NEAR(built.system.total_mass, density * 8, 1e-8);
}

/// Force of an affine displacement is zero inside and equals the traction resultant at the ends.
TEST(System, ProductOfAUniaxialStretchIsTheBarForce) {
  const GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {4, 2, 1}, {5, 3, 2});
  Built built = build_system(global, testing_support::solid_structure("box", young, 0.0, density));
  std::vector<double> w(built.system.lumped_mass.size(), 0.0);
  std::vector<double> q(w.size(), 0.0);
  for (LocalIndex node = 0; node < built.mesh.owned_nodes; ++node) {
    w[static_cast<std::size_t>(built.mesh.dof(node, 0))] = 1e-4 * built.mesh.position(node)[0];
  }
  const VecHandle argument = wrap_vector(built.system, w);
  const VecHandle force = wrap_vector(built.system, q);
  built.system.stiffness->apply(argument.get(), force.get());
  std::array<double, 3> sums{};  // force at x = 4, at x = 0, largest inside
  for (LocalIndex node = 0; node < built.mesh.owned_nodes; ++node) {
    const double f = q[static_cast<std::size_t>(built.mesh.dof(node, 0))];
    const double x = built.mesh.position(node)[0];
    if (x > 3.999) {
      sums[0] += f;
    } else if (x < 1e-3) {
      sums[1] += f;
    } else {
      sums[2] += std::abs(f);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  const double expected = young * 1e-4 * 2;
  EXPECT_NEAR(sums[0], expected, 1e-9 * expected);
  EXPECT_NEAR(sums[1], -expected, 1e-9 * expected);
  EXPECT_NEAR(sums[2], 0, 1e-7 * expected);
}

/// A bar of N cubes without Poisson effect, guided sideways: c sin((2j - 1) pi / 4N) / (pi h).
TEST(System, ModesOfAFixedFreeBarAreTheLumpedClosedForm) {
  constexpr int cells = 12;
  GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {6, 0.5, 0.5}, {cells, 1, 1});
  testing_support::clamp(global, "x_min");
  for (auto& mask : global.free_components) {
    mask &= 0x01;
  }
  const Built built =
      build_system(global, testing_support::solid_structure("bar", young, 0.0, density));
  const ModalResult result = lowest_modes(built.system, built.mesh, 3);
  const double speed = std::sqrt(young / density);
  for (int j = 1; j <= 3; ++j) {
    const double expected =
        speed / (std::numbers::pi * 0.5) * std::sin((2 * j - 1) * std::numbers::pi / (4 * cells));
    EXPECT_NEAR(result.modes[static_cast<std::size_t>(j - 1)].frequency / expected, 1, 1e-9);
  }
  EXPECT_EQ(result.modes[0].direction, "x");
  // The first mode of a fixed-free bar carries about 8 / pi^2 of the mass.
  EXPECT_NEAR(result.modes[0].effective_modal_mass[0] / built.system.total_mass,
              8 / (std::numbers::pi * std::numbers::pi), 0.05);
  const double largest =
      2 * speed / 0.5 * std::sin((2 * cells - 1) * std::numbers::pi / (4 * cells));
  EXPECT_NEAR(largest_frequency(built.system, built.mesh).omega_max / largest, 1, 1e-8);
  // One free cube of the bar alone: 2 c / h, the bound.
  EXPECT_GE(built.system.element_frequency_bound, largest);
}

TEST(System, FreeBodyHasSixRigidModes) {
  const GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {3, 2.5, 0.22}, {6, 5, 1});
  const Built built =
      build_system(global, testing_support::solid_structure("slab", young, 0.2, density));
  const ModalResult result = lowest_modes(built.system, built.mesh, 8);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(result.modes[i].frequency, 0.01);
  }
  EXPECT_GT(result.modes[6].frequency, 50);
}

TEST(System, RefusesAnImpossibleElementOnEveryRank) {
  GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {4, 2, 1}, {4, 2, 1});
  std::swap(global.regions[0].connectivity[0], global.regions[0].connectivity[6]);
  const std::string message = testing_support::refusal_of(
      [&] { build_system(global, testing_support::solid_structure("box", young, 0.2, density)); });
  EXPECT_NE(message.find("element 1 of group 'body'"), std::string::npos) << message;
}

TEST(Partition, LinkedNodesStayOnOneRank) {
  const std::vector<GlobalMesh> meshes{testing_support::box_mesh({0, 0, 0}, {8, 2, 1}, {16, 4, 2}),
                                       testing_support::box_mesh({8, 0, 0}, {8, 2, 1}, {16, 4, 2})};
  std::vector<NodeLink> links;
  const auto& left = meshes[0].groups.at("x_max").nodes;
  const auto& right = meshes[1].groups.at("x_min").nodes;
  for (std::size_t i = 0; i < left.size(); ++i) {
    links.push_back({0, left[i], 1, right[i]});
  }
  const int parts = size_of(PETSC_COMM_WORLD);
  const Partition partition = partition_meshes(meshes, links, parts);
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(partition.node_owner[0][static_cast<std::size_t>(left[i])],
              partition.node_owner[1][static_cast<std::size_t>(right[i])]);
  }
  EXPECT_LT(partition.imbalance, 1.1);
  const Partition again = partition_meshes(meshes, links, parts);
  EXPECT_EQ(partition.node_owner, again.node_owner);
}

int owners_of(const std::vector<int>& owner) {
  return static_cast<int>(std::set<int>(owner.begin(), owner.end()).size());
}

TEST(Partition, KeepsStructuresWholeWhereSharingCostsMore) {
  for (const int cells : {4, 20}) {
    const std::vector<GlobalMesh> meshes{
        testing_support::box_mesh({0, 0, 0}, {4, 2, 1}, {2 * cells, cells, 4}),
        testing_support::box_mesh({5, 0, 0}, {2, 2, 1}, {cells, cells, 4})};
    const auto share = [&](PartitionBy by, int parts) {
      return partition_meshes(meshes, {}, parts, {}, {}, by);
    };
    const Partition cut = share(PartitionBy::elements, 2);
    EXPECT_LT(cut.imbalance, 1.05);
    EXPECT_EQ(owners_of(cut.element_owner[0]) + owners_of(cut.element_owner[1]), 3);
    const Partition whole = share(PartitionBy::structures, 2);
    EXPECT_NEAR(whole.imbalance, 4.0 / 3, 1e-12);
    EXPECT_EQ(whole.edge_cut, 0);
    for (const auto* owners : {&whole.element_owner, &whole.node_owner}) {
      EXPECT_EQ(owners_of((*owners)[0]), 1);
      EXPECT_EQ(owners_of((*owners)[1]), 1);
      EXPECT_NE((*owners)[0][0], (*owners)[1][0]);
    }
    // Small buildings wait for messages longer than they compute; large ones are worth cutting.
    const Partition chosen = share(PartitionBy::automatic, 2);
    EXPECT_EQ(chosen.element_owner, cells < 10 ? whole.element_owner : cut.element_owner);
    EXPECT_EQ(owners_of(share(PartitionBy::structures, 1).element_owner[0]), 1);
  }
}

TEST(Partition, MoreRanksThanElementsLeavesSomeEmpty) {
  const std::vector<GlobalMesh> meshes{testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {2, 1, 1})};
  const Partition partition = partition_meshes(meshes, {}, 5);
  for (const int owner : partition.node_owner[0]) {
    EXPECT_GE(owner, 0);
    EXPECT_LT(owner, 2);
  }
}

}  // namespace system_test
}  // namespace pounding
