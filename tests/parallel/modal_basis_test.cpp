#include "modal/modal_basis.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "modal/block_krylov.h"
#include "modal/eigen_solver.h"
#include "support/box_mesh.h"
#include "support/built_system.h"

namespace pounding {
namespace modal_basis_test {

using testing_support::build_system;
using testing_support::BuiltSystem;

const Structure& concrete() {
  static const Structure structure = testing_support::solid_structure("box", 30e9, 0.2, 2400);
  return structure;
}

GlobalMesh tower(bool clamped, std::array<int, 3> cells = {5, 4, 9}) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2, 2.3, 6}, cells);
  if (clamped) testing_support::clamp(mesh, "z_min");
  return mesh;
}

ModalRequest request_of(const GlobalMesh& mesh, int modes) {
  ModalRequest request;
  request.modes = modes;
  for (const GlobalIndex node : mesh.groups.at("z_max").nodes) {
    request.contact_points.push_back({node, 0});
  }
  // A clamped point, one twice, and one of the contact.
  request.other_points = {{mesh.groups.at("z_min").nodes.front(), 1},
                          {mesh.groups.at("z_max").nodes.front(), 0},
                          {mesh.groups.at("x_max").nodes.back(), 2},
                          {mesh.groups.at("x_max").nodes.back(), 2}};
  return request;
}

/// The whole on one rank, of every rank alone.
BuiltSystem alone(const GlobalMesh& mesh, const Structure& structure) {
  return build_system(MPI_COMM_SELF, mesh, structure,
                      partition_meshes({&mesh, 1}, {}, 1, {}, coupled_nodes(structure, mesh, 0)));
}

/// Flexibility at the points by the vectors that are not rigid motions.
std::vector<double> flexibility(const ModalBasis& basis) {
  const std::size_t count = basis.points.size();
  std::vector<double> matrix(count * count, 0.0);
  for (std::size_t k = 0; k < basis.size(); ++k) {
    if (basis.squared_frequency[k] < 1) continue;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        matrix[i * count + j] += basis.rows[i * basis.size() + k] *
                                 basis.rows[j * basis.size() + k] / basis.squared_frequency[k];
      }
    }
  }
  return matrix;
}

void expect_same(const ModalBasis& found, const ModalBasis& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(found.modes, expected.modes);
  EXPECT_EQ(found.attachment_vectors, expected.attachment_vectors);
  EXPECT_EQ(found.mode_numbers, expected.mode_numbers);
  EXPECT_EQ(found.points, expected.points);
  EXPECT_NEAR(found.mass / expected.mass, 1, 1e-12);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double scale = std::max(expected.squared_frequency[k], 1e3);
    EXPECT_NEAR(found.squared_frequency[k], expected.squared_frequency[k], tolerance * scale) << k;
  }
  const std::vector<double> one = flexibility(found);
  const std::vector<double> other = flexibility(expected);
  const double largest = *std::ranges::max_element(other);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], tolerance * largest);
  for (std::size_t motion = 0; motion < 6; ++motion) {
    const auto square = [&](const ModalBasis& basis) {
      const double* gamma = &basis.participation[motion * basis.size()];
      return std::inner_product(gamma, gamma + basis.size(), gamma, 0.0);
    };
    EXPECT_NEAR(square(found) / square(expected), 1, tolerance) << motion;
  }
}

void compare(const GlobalMesh& mesh, const Structure& structure, const ModalRequest& request,
             double tolerance = 1e-7) {
  const BuiltSystem shared = build_system(mesh, structure);
  const BuiltSystem whole = alone(mesh, structure);
  expect_same(compute_modal_basis(shared.system, shared.mesh, request),
              compute_modal_basis(whole.system, whole.mesh, request), tolerance);
}

TEST(ModalBasisOfRanks, IsThatOfOneRank) {
  const GlobalMesh mesh = tower(true);
  compare(mesh, concrete(), request_of(mesh, 20));
}

TEST(ModalBasisOfRanks, OfAFreeBody) {
  const GlobalMesh mesh = tower(false);
  compare(mesh, concrete(), request_of(mesh, 20), 1e-6);
}

TEST(ModalBasisOfRanks, UnderItsWeightAndWithChosenModes) {
  const GlobalMesh mesh = tower(true);
  ModalRequest request = request_of(mesh, 20);
  request.candidates = 40;
  request.gravity = {0, 0, -9.81};
  compare(mesh, concrete(), request);
}

/// Weight along an axis in which nothing can move asks for no vector.
TEST(ModalBasisOfRanks, UnderAWeightThatIsHeld) {
  GlobalMesh mesh = tower(true);
  for (std::uint8_t& mask : mesh.free_components) mask = static_cast<std::uint8_t>(mask & ~0x4U);
  ModalRequest request = request_of(mesh, 8);
  request.attachment = false;
  request.gravity = {0, 0, -9.81};
  const BuiltSystem shared = build_system(mesh, concrete());
  const ModalBasis basis = compute_modal_basis(shared.system, shared.mesh, request);
  EXPECT_EQ(basis.attachment_vectors, 0);
  request.gravity = {9.81, 0, 0};
  const ModalBasis leaning = compute_modal_basis(shared.system, shared.mesh, request);
  EXPECT_EQ(leaning.attachment_vectors, 1);
  for (const double square : leaning.squared_frequency) EXPECT_TRUE(std::isfinite(square));
}

/// Displacement of each point under equal forces on all of the contact.
std::vector<double> under_equal_forces(const ModalBasis& basis, const ModalRequest& request) {
  const std::vector<double> matrix = flexibility(basis);
  const std::size_t count = basis.points.size();
  std::vector<double> sums(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const bool loaded = std::ranges::find(request.contact_points, basis.points[j]) !=
                          request.contact_points.end();
      if (loaded) sums[i] += matrix[i * count + j];
    }
  }
  return sums;
}

TEST(ModalBasisOfRanks, WithPatchesOfContactPoints) {
  const GlobalMesh mesh = tower(true);
  ModalRequest request = request_of(mesh, 6);
  const BuiltSystem shared = build_system(mesh, concrete());
  const ModalBasis all = compute_modal_basis(shared.system, shared.mesh, request);
  EXPECT_EQ(all.attachment_vectors, static_cast<int>(request.contact_points.size()));
  for (const int patches : {1, 4}) {
    request.patches = patches;
    compare(mesh, concrete(), request);
    const ModalBasis few = compute_modal_basis(shared.system, shared.mesh, request);
    EXPECT_EQ(few.attachment_vectors, patches);
    // What is the sum of the patches' loads is answered as by all vectors, what is not is stiffer.
    const std::vector<double> found = under_equal_forces(few, request);
    const std::vector<double> expected = under_equal_forces(all, request);
    for (std::size_t i = 0; i < request.contact_points.size(); ++i) {
      EXPECT_NEAR(found[i] / expected[i], 1, 1e-6) << i;
      const std::size_t own = i * all.points.size() + i;
      EXPECT_LT(flexibility(few)[own], 0.99 * flexibility(all)[own]) << i;
    }
  }
}

TEST(ModalBasisOfRanks, OfEveryMode) {
  const GlobalMesh mesh = tower(true, {2, 2, 3});
  compare(mesh, concrete(), request_of(mesh, 10000));
}

TEST(ModalBasisOfRanks, BelowACutOff) {
  const GlobalMesh mesh = tower(true);
  ModalRequest request = request_of(mesh, 0);
  request.cutoff = 600;
  compare(mesh, concrete(), request);
}

TEST(ModalBasisOfRanks, WithARigidFloor) {
  GlobalMesh mesh = tower(true);
  Structure structure = concrete();
  RigidNodes roof;
  roof.group = "z_max";
  roof.components = 0x3f;
  roof.nodes = mesh.groups.at("z_max").nodes;
  mesh.rigid.push_back(roof);
  ModalRequest request = request_of(mesh, 12);
  request.contact_points.clear();
  for (const GlobalIndex node : mesh.groups.at("x_max").nodes) {
    request.contact_points.push_back({node, 0});
  }
  compare(mesh, structure, request);
}

/// All frequencies of a full matrix beside the lowest that the Krylov space finds. A square section
/// has them in pairs, a cube three times over. `rigid` [1/s2]: below it the full matrix is rounding.
void expect_lowest(const GlobalMesh& mesh, int count, double rigid = 1e3) {
  const BuiltSystem shared = build_system(mesh, concrete());
  ASSERT_GT(static_cast<std::size_t>(shared.system.global_dofs), largest_krylov_space(count + 8));
  ModalRequest request;
  request.attachment = false;
  request.modes = count;
  const ModalBasis lowest = compute_modal_basis(shared.system, shared.mesh, request);
  request.modes = static_cast<int>(shared.system.global_dofs);
  const ModalBasis all = compute_modal_basis(shared.system, shared.mesh, request);
  ASSERT_GE(lowest.size(), static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < lowest.size(); ++k) {
    const double scale = std::max(all.squared_frequency[k], rigid);
    EXPECT_NEAR(lowest.squared_frequency[k], all.squared_frequency[k], 1e-8 * scale) << k;
  }
}

TEST(BlockKrylov, FindsWhatAFullMatrixHas) {
  expect_lowest(tower(true, {4, 4, 8}), 30);
}

TEST(BlockKrylov, FindsEveryOneOfEqualFrequencies) {
  GlobalMesh mast = testing_support::box_mesh({0, 0, 0}, {1, 1, 6}, {3, 3, 14});
  testing_support::clamp(mast, "z_min");
  expect_lowest(mast, 25);
  expect_lowest(testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {5, 5, 5}), 30);
}

TEST(BlockKrylov, FindsRigidMotionsBesideFastModes) {
  expect_lowest(tower(false, {4, 3, 8}), 20);
  expect_lowest(testing_support::box_mesh({0, 0, 0}, {0.02, 0.015, 0.5}, {3, 2, 30}), 20, 1.3e5);
  expect_lowest(testing_support::box_mesh({0, 0, 0}, {0.002, 0.0015, 0.05}, {3, 2, 30}), 60, 1.3e7);
}

/// Copies of a mesh beside each other, which nothing joins.
GlobalMesh copies_of(const GlobalMesh& one, int count) {
  GlobalMesh all = one;
  for (int copy = 1; copy < count; ++copy) {
    const auto first = static_cast<GlobalIndex>(copy) * one.node_count();
    for (GlobalIndex node = 0; node < one.node_count(); ++node) {
      const Vector3 x = one.position(node);
      all.coordinates.insert(all.coordinates.end(), {x[0] + 3 * copy, x[1], x[2]});
      all.node_tags.push_back(one.node_tags.back() * copy + one.node_tags[node]);
      all.components.push_back(one.components[node]);
      all.free_components.push_back(one.free_components[node]);
    }
    const ElementSet& set = one.regions[0];
    const auto elements = static_cast<std::int64_t>(set.tags.size());
    for (const std::int64_t tag : set.tags) all.regions[0].tags.push_back(copy * elements + tag);
    for (const GlobalIndex node : set.connectivity) {
      all.regions[0].connectivity.push_back(first + node);
    }
  }
  return all;
}

TEST(BlockKrylov, FindsMoreEqualFrequenciesThanABlockHasColumns) {
  GlobalMesh post = testing_support::box_mesh({0, 0, 0}, {1, 1, 3}, {1, 1, 3});
  testing_support::clamp(post, "z_min");
  expect_lowest(copies_of(post, 23), 50);
  expect_lowest(copies_of(post, 40), 90);
}

/// Most dofs of a rigid body stand idle: fewer motions than a block would like to have.
TEST(BlockKrylov, EndsWhereThereIsNothingMore) {
  GlobalMesh mesh = tower(true, {6, 6, 10});
  RigidNodes body;
  body.group = "x_max";
  body.components = 0x3f;
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    if (mesh.position(node)[2] > 1.5) body.nodes.push_back(node);
  }
  mesh.rigid.push_back(body);
  const BuiltSystem shared = build_system(mesh, concrete());
  const GlobalIndex motions = shared.system.independent_dofs();
  ASSERT_LT(2 * motions, shared.system.global_dofs);
  ModalRequest request;
  request.attachment = false;
  for (const GlobalIndex count : {GlobalIndex{10}, motions - 3, motions}) {
    request.modes = static_cast<int>(count);
    const ModalBasis basis = compute_modal_basis(shared.system, shared.mesh, request);
    EXPECT_GE(basis.modes, static_cast<int>(count));
    EXPECT_LE(basis.modes, static_cast<int>(motions));
  }
}

TEST(BlockKrylov, CutsItsSpaceDownAndGoesOn) {
  GlobalMesh mesh = tower(true, {6, 6, 10});
  const BuiltSystem shared = build_system(mesh, concrete());
  const MatHandle matrix = mass_scaled(shared.system, shared.system.stiffest_matrix());
  const ShiftedSolver solver(matrix.get(), lowest_shift);
  const Eigenpairs few = lowest_eigenpairs(shared.system, shared.mesh, solver, 10);
  const Eigenpairs many = lowest_eigenpairs(shared.system, shared.mesh, solver, 150);
  ASSERT_GE(many.values.size(), 150U);
  EXPECT_TRUE(std::ranges::is_sorted(many.values));
  for (std::size_t k = 0; k < few.values.size(); ++k) {
    EXPECT_NEAR(few.values[k] / many.values[k], 1, 1e-9) << k;
  }
  // A x = lambda x, and columns of length 1 at right angles.
  DenseMatrix gram = transposed_product(many.vectors, many.vectors);
  MPI_Allreduce(MPI_IN_PLACE, gram.values.data(), static_cast<int>(gram.values.size()), MPI_DOUBLE,
                MPI_SUM, shared.system.comm);
  for (std::size_t i = 0; i < gram.columns; ++i) {
    for (std::size_t j = 0; j < gram.columns; ++j) {
      EXPECT_NEAR(gram.column(i)[j], i == j ? 1 : 0, 1e-12) << i << " " << j;
    }
  }
  for (std::size_t k = 0; k < many.values.size(); ++k) {
    std::vector<double> x(many.vectors.column(k), many.vectors.column(k) + many.vectors.rows);
    std::vector<double> y(x.size());
    const VecHandle from = wrap_vector(shared.system, x);
    const VecHandle to = wrap_vector(shared.system, y);
    POUNDING_PETSC(MatMult(matrix.get(), from.get(), to.get()));
    POUNDING_PETSC(VecAXPY(to.get(), -many.values[k], from.get()));
    double rest = 0;
    POUNDING_PETSC(VecNorm(to.get(), NORM_2, &rest));
    EXPECT_LT(rest, 1e-6 * many.values[k]) << k;
  }
}

}  // namespace modal_basis_test
}  // namespace pounding
