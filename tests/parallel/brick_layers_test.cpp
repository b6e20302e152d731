// Layers of bricks in every position, cut between ranks in every way, and the symmetry of the
// product for meshes that are regular to round-off only.

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "support/box_mesh.h"
#include "support/built_stiffness.h"

namespace pounding {
namespace brick_layers_test {

using testing_support::build_stiffness;
using testing_support::BuiltStiffness;
using testing_support::difference_to_assembled;
using testing_support::move_nodes;
using testing_support::random_field;

constexpr double tolerance = 1e-13;
constexpr double noise = 1e-12;  // [m]

Structure concrete() {
  return testing_support::solid_structure("box", 30e9, 0.2, 2400);
}

/// Owners of the nodes by place.
Partition partition_by(const GlobalMesh& mesh, int parts,
                       const std::function<int(Vector3)>& owner) {
  Partition partition;
  partition.parts = parts;
  auto& owners = partition.node_owner.emplace_back();
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    owners.push_back(owner(mesh.position(node)) % parts);
  }
  return partition;
}

void turn(GlobalMesh& mesh) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  move_nodes(mesh, [=](Vector3 x) {
    const Vector3 y{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    return Vector3{y[0], c * y[1] - s * y[2], s * y[1] + c * y[2]};
  });
}

void add_noise(GlobalMesh& mesh) {
  std::mt19937 generator(17);
  std::uniform_real_distribution<double> values(-noise, noise);
  for (double& x : mesh.coordinates) x += values(generator);
}

constexpr std::array<std::array<int, 3>, 6> slabs{
    {{21, 13, 1}, {13, 21, 1}, {21, 1, 13}, {13, 1, 21}, {1, 21, 13}, {1, 13, 21}}};

GlobalMesh slab_of(const std::array<int, 3>& cells) {
  return testing_support::box_mesh({1, -2, 0}, {0.25 * cells[0], 0.3 * cells[1], 0.22 * cells[2]},
                                   cells);
}

TEST(BrickLayers, ThinSlabsOnEveryAxis) {
  for (const auto& cells : slabs) {
    for (const bool turned : {false, true}) {
      for (const bool clamped : {false, true}) {
        GlobalMesh mesh = slab_of(cells);
        if (turned) turn(mesh);
        if (clamped) {
          for (std::size_t i = 0; i < mesh.free_components.size(); i += 37) {
            mesh.free_components[i] = 0;
          }
          testing_support::clamp(mesh, "x_max");
        }
        const auto built = build_stiffness(mesh, concrete());
        EXPECT_EQ(built.stiffness->kinds().bricks, 273);
        EXPECT_LT(difference_to_assembled(built), tolerance)
            << cells[0] << " x " << cells[1] << " x " << cells[2] << (turned ? ", turned" : "")
            << (clamped ? ", clamped" : "");
      }
    }
  }
}

TEST(BrickLayers, SeveralLayers) {
  for (const std::array<int, 3>& cells :
       {std::array<int, 3>{12, 9, 2}, {3, 12, 9}, {9, 2, 12}, {4, 5, 6}}) {
    for (const bool turned : {false, true}) {
      GlobalMesh mesh = slab_of(cells);
      testing_support::clamp(mesh, "z_min");
      if (turned) turn(mesh);
      EXPECT_LT(difference_to_assembled(build_stiffness(mesh, concrete())), tolerance);
    }
  }
}

/// Ranks own corners of the slab, stripes or single nodes in turn.
TEST(BrickLayers, CutsInBothDirections) {
  const int ranks = size_of(PETSC_COMM_WORLD);
  const std::vector<std::function<int(Vector3)>> owners{
      [](Vector3 x) { return x[0] > 3.4 && x[1] > 0.1 ? 1 : 0; },
      [](Vector3 x) { return (x[0] > 3.4 ? 1 : 0) + (x[1] > 0.1 ? 1 : 0); },
      [](Vector3 x) { return static_cast<int>(x[0] + 0.7 * x[1] + 20); },
      [](Vector3 x) { return x[2] > 0.1 ? 1 : 0; },
      [](Vector3 x) { return static_cast<int>(std::abs(1e4 * std::sin(13 * x[0] + 7 * x[1]))); }};
  for (std::size_t i = 0; i < owners.size(); ++i) {
    for (const bool turned : {false, true}) {
      GlobalMesh mesh = slab_of({21, 13, 1});
      for (std::size_t n = 0; n < mesh.free_components.size(); n += 41) mesh.free_components[n] = 2;
      const Partition partition = partition_by(mesh, ranks, owners[i]);
      if (turned) turn(mesh);
      const auto built = build_stiffness(PETSC_COMM_WORLD, mesh, concrete(), partition);
      EXPECT_EQ(built.stiffness->kinds().bricks, 273);
      EXPECT_LT(difference_to_assembled(built), tolerance) << "partition " << i;
    }
  }
}

TEST(BrickLayers, SlabWithOpenings) {
  GlobalMesh mesh = slab_of({21, 13, 1});
  auto& set = mesh.regions[0];
  std::vector<std::int64_t> tags;
  std::vector<GlobalIndex> connectivity;
  std::vector<char> used(mesh.node_tags.size(), 0);
  for (std::size_t e = 0; e < set.tags.size(); ++e) {
    const std::size_t i = e % 21;
    const std::size_t j = e / 21;
    if ((i >= 9 && i < 12 && j >= 4 && j < 9) || (i > 15 && j > 2 * (i - 13))) continue;
    tags.push_back(set.tags[e]);
    for (std::size_t a = 8 * e; a < 8 * e + 8; ++a) {
      connectivity.push_back(set.connectivity[a]);
      used[static_cast<std::size_t>(set.connectivity[a])] = 1;
    }
  }
  set.tags = tags;
  set.connectivity = connectivity;
  for (std::size_t n = 0; n < used.size(); ++n) {
    if (used[n] == 0) mesh.free_components[n] = 0;
  }
  EXPECT_LT(difference_to_assembled(build_stiffness(mesh, concrete())), tolerance);
}

/// |y^T K x - x^T K y| over the sum of |y_i (K x)_i|.
double asymmetry(const BuiltStiffness& built) {
  const std::vector<double> x = random_field(built.mesh, 1);
  const std::vector<double> y = random_field(built.mesh, 2);
  std::vector<double> kx(x.size());
  std::vector<double> ky(x.size());
  built.stiffness->apply(x.data(), kx.data());
  built.stiffness->apply(y.data(), ky.data());
  std::array<long double, 2> sums{0, 0};  // of the difference, of the size
  for (std::size_t i = 0; i < x.size(); ++i) {
    sums[0] += static_cast<long double>(y[i]) * kx[i] - static_cast<long double>(x[i]) * ky[i];
    sums[1] += std::abs(y[i] * kx[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_LONG_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return static_cast<double>(std::abs(sums[0]) / sums[1]);
}

/// Largest difference to the product of one rank alone, over the largest force.
double difference_to_one_rank(const BuiltStiffness& built, const GlobalMesh& mesh) {
  const auto whole = build_stiffness(PETSC_COMM_SELF, mesh, concrete(),
                                     partition_by(mesh, 1, [](Vector3) { return 0; }));
  const std::vector<double> x = random_field(built.mesh, 1);
  const std::vector<double> x_whole = random_field(whole.mesh, 1);
  std::vector<double> force(x.size());
  std::vector<double> force_whole(x_whole.size());
  built.stiffness->apply(x.data(), force.data());
  whole.stiffness->apply(x_whole.data(), force_whole.data());
  double largest = 0;
  double scale = 0;
  for (LocalIndex node = 0; node < built.mesh.owned_nodes; ++node) {
    const LocalIndex there =
        whole.mesh.owned_node(built.mesh.file_node[static_cast<std::size_t>(node)]);
    for (int c = 0; c < 3; ++c) {
      const LocalIndex dof = built.mesh.dof(node, c);
      if (dof < 0) continue;
      const double expected = force_whole[static_cast<std::size_t>(whole.mesh.dof(there, c))];
      largest = std::max(largest, std::abs(force[static_cast<std::size_t>(dof)] - expected));
      scale = std::max(scale, std::abs(expected));
    }
  }
  return scale > 0 ? largest / scale : 0;
}

/// Every rank takes the same box, or the same shape, for elements that differ by noise.
TEST(BrickLayers, SymmetricAndTheSameOnAnyNumberOfRanks) {
  enum class Kind { straight, turned, sheared, distorted };
  for (const Kind kind : {Kind::straight, Kind::turned, Kind::sheared, Kind::distorted}) {
    for (const std::array<int, 3>& cells : {std::array<int, 3>{21, 13, 1}, {9, 8, 3}}) {
      GlobalMesh mesh = slab_of(cells);
      if (kind == Kind::turned) turn(mesh);
      if (kind == Kind::sheared) {
        move_nodes(mesh, [](Vector3 x) { return Vector3{x[0] + 0.3 * x[1], x[1], x[2]}; });
      }
      if (kind == Kind::distorted) {
        move_nodes(mesh, [](Vector3 x) {
          return Vector3{x[0] + 0.05 * std::sin(3 * x[1]), x[1] + 0.05 * std::cos(2 * x[0]), x[2]};
        });
      }
      add_noise(mesh);
      testing_support::clamp(mesh, "x_min");
      const auto built = build_stiffness(mesh, concrete());
      const stiffness::ElementKinds kinds = built.stiffness->kinds();
      EXPECT_EQ(kinds.bricks > 0, kind == Kind::straight || kind == Kind::turned);
      EXPECT_EQ(kinds.general > 0, kind == Kind::sheared || kind == Kind::distorted);
      const auto name = static_cast<int>(kind);
      EXPECT_LT(asymmetry(built), 1e-15) << "kind " << name;
      EXPECT_LT(difference_to_one_rank(built, mesh), 1e-14) << "kind " << name;
      EXPECT_LT(difference_to_assembled(built), 1e-10) << "kind " << name;
    }
  }
}

}  // namespace brick_layers_test
}  // namespace pounding
