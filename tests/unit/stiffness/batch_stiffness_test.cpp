// The product in eight runs at once is eight products, for elements of every kind.

#include "stiffness/batch_stiffness.h"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "support/box_mesh.h"
#include "support/built_stiffness.h"
#include "support/frame_mesh.h"

namespace pounding {
namespace batch_stiffness_test {

using testing_support::build_stiffness;
using testing_support::BuiltStiffness;
using testing_support::FrameMesh;
using testing_support::move_nodes;

void expect_eight_products(const GlobalMesh& mesh, const Structure& structure) {
  const BuiltStiffness built = build_stiffness(mesh, structure);
  const stiffness::BatchStiffness together(structure, built.mesh);
  const std::size_t dofs = built.system.lumped_mass.size();
  const std::vector<BatchValue> zeros(dofs, BatchValue{});
  std::vector<BatchValue> u = zeros, v = zeros, q = zeros;
  BatchValue beta{};
  std::array<std::vector<double>, batch_size> expected;
  double largest = 0;
  for (std::size_t run = 0; run < batch_size; ++run) {
    const std::vector<double> displacement =
        testing_support::random_field(built.mesh, static_cast<unsigned>(run) + 1);
    const std::vector<double> velocity =
        testing_support::random_field(built.mesh, static_cast<unsigned>(run) + 101);
    beta[run] = 0.1 * static_cast<double>(run);
    expected[run].assign(dofs, NAN);
    stiffness::StoredForces store(expected[run].data());
    built.stiffness->apply(
        stiffness::StiffnessArgument{displacement.data(), velocity.data(), beta[run]}, store);
    for (std::size_t i = 0; i < dofs; ++i) {
      u[i][run] = displacement[i];
      v[i][run] = velocity[i];
      largest = std::max(largest, std::abs(expected[run][i]));
    }
  }
  stiffness::StoredForces store(q.data());
  for (int again = 0; again < 2; ++again) {  // nothing is left of a product in the next one
    together.apply({u.data(), v.data(), beta}, store);
    for (std::size_t i = 0; i < dofs; ++i) {
      for (std::size_t run = 0; run < batch_size; ++run) {
        ASSERT_NEAR(q[i][run], expected[run][i], 1e-13 * largest) << "dof " << i << " run " << run;
      }
    }
  }
}

Structure concrete() {
  return testing_support::solid_structure("box", 30e9, 0.2, 2400);
}

TEST(BatchStiffness, BricksAndHexahedra) {
  for (const double bent : {0.0, 0.05}) {
    GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {4, 3, 2}, {5, 4, 3});
    testing_support::clamp(mesh, "z_min");
    for (std::size_t n = 60; n < mesh.free_components.size(); n += 7) mesh.free_components[n] = 5;
    move_nodes(mesh, [&](Vector3 x) {
      return Vector3{x[0] + bent * std::sin(3 * x[1] + x[2]), x[1] + bent * x[0] * x[2],
                     x[2] + bent * std::sin(5 * x[0])};
    });
    expect_eight_products(mesh, concrete());
  }
}

TEST(BatchStiffness, WindowsGoRoundTheRing) {
  for (const std::array<int, 3> cells : {std::array{3, 2, 40}, std::array{40, 3, 2}}) {
    GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {4, 3, 2}, cells);
    testing_support::clamp(mesh, "z_min");
    move_nodes(mesh, [&](Vector3 x) {
      return Vector3{x[0] + 0.01 * std::sin(3 * x[1] + x[2]), x[1], x[2] + 0.01 * x[0] * x[1]};
    });
    expect_eight_products(mesh, concrete());
  }
}

TEST(BatchStiffness, ExtrudedAlongEveryAxis) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {4, 3, 2}, {5, 4, 3});
    move_nodes(mesh, [&](Vector3 x) {
      const std::size_t d = (axis + 1) % 3, e = (axis + 2) % 3;
      x[d] += 0.1 * std::sin(3 * x[e]);
      return x;
    });
    for (std::size_t n = 0; n < mesh.free_components.size(); n += 4) mesh.free_components[n] = 6;
    expect_eight_products(mesh, concrete());
  }
}

/// Plates, the second one of quadrangles out of right angles, on beams.
FrameMesh floors() {
  FrameMesh frame;
  frame.add_plate({0, 0, 2}, {3, 0, 0}, {0, 2.5, 0}, {5, 4}, 0.22);
  frame.add_plate({0, 0, 4}, {3, 0, 0.4}, {0.5, 2.5, 0}, {5, 4}, 0.2);
  frame.add_beams({0, 0, 0}, {0, 0, 2}, 3, {1, 0, 0});
  frame.add_beams({0, 0, 2}, {0, 0, 4}, 2, {1, 0, 0});
  frame.add_beams({3, 2.5, 0}, {3, 2.5, 2}, 3, {1, 0.2, 0});
  frame.clamp({0, 0, 0});
  frame.clamp({3, 2.5, 0});
  return frame;
}

TEST(BatchStiffness, PlatesOnBeams) {
  FrameMesh frame = floors();
  expect_eight_products(frame.mesh(), frame.structure());
}

TEST(BatchStiffness, TrianglesAndBeamsInASparseMatrix) {
  FrameMesh frame = floors();
  Structure structure = frame.structure();
  GlobalMesh& mesh = frame.mesh();
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    ElementSet& set = mesh.regions[r];
    if (set.type != ElementType::shell4) continue;
    const std::vector<GlobalIndex> corners = std::move(set.connectivity);
    const std::size_t count = set.tags.size();
    set.type = structure.regions[r].element = ElementType::shell3;
    set.connectivity.clear();
    for (std::size_t e = 0; e < count; ++e) {
      const GlobalIndex* const q = &corners[4 * e];
      set.connectivity.insert(set.connectivity.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
      set.tags.push_back(100000 + static_cast<std::int64_t>(100 * r + e));
    }
  }
  // A node that is held in part has its beams in the sparse matrix.
  mesh.free_components[mesh.regions.back().connectivity[2]] = 0x3e;
  expect_eight_products(mesh, structure);
}

}  // namespace batch_stiffness_test
}  // namespace pounding
