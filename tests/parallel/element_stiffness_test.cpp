#include "system/element_stiffness.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "support/box_mesh.h"
#include "support/built_system.h"
#include "system/finite_element_system.h"

namespace pounding {
namespace {

constexpr double young = 30e9;
constexpr double density = 2400;

struct Built {
  Mesh mesh;
  LinearSystem system;
  std::unique_ptr<ElementStiffness> stiffness;
};

Built build(const GlobalMesh& global, const Structure& structure) {
  testing::BuiltSystem assembled = testing::build_system(global, structure);
  Built built{std::move(assembled.mesh), std::move(assembled.system), nullptr};
  built.stiffness =
      std::make_unique<ElementStiffness>(structure, built.mesh, std::move(built.system.stiffness));
  return built;
}

Structure concrete(ElementType type = ElementType::hex8) {
  return testing::solid_structure("box", young, 0.2, density, type);
}

/// One value per node of the file and component, whatever the number of ranks.
std::vector<double> random_field(const Mesh& mesh, unsigned seed) {
  std::vector<double> field(static_cast<std::size_t>(mesh.owned_dofs));
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    const auto number = static_cast<unsigned>(mesh.file_node[static_cast<std::size_t>(node)]);
    std::mt19937 generator(seed + 7919 * number);
    std::uniform_real_distribution<double> values(-1, 1);
    for (int c = 0; c < 6; ++c) {
      const double value = values(generator);
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0) field[static_cast<std::size_t>(dof)] = value;
    }
  }
  return field;
}

/// Largest difference to the assembled product, over the largest force, on all ranks.
double difference_to_assembled(const Built& built) {
  std::array<double, 2> largest{0, 0};
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::vector<double> w = random_field(built.mesh, seed);
    std::vector<double> expected(w.size(), 0.0);
    std::vector<double> found(w.size(), NAN);
    const VecHandle argument = wrap_vector(built.system, w);
    const VecHandle assembled = wrap_vector(built.system, expected);
    const VecHandle force = wrap_vector(built.system, found);
    POUNDING_PETSC(MatMult(built.stiffness->matrix(), argument.get(), assembled.get()));
    built.stiffness->apply(argument.get(), force.get());
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double error = std::abs(found[i] - expected[i]);
      largest[0] = std::isfinite(error) ? std::max(largest[0], error) : INFINITY;
      largest[1] = std::max(largest[1], std::abs(expected[i]));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return largest[0] / largest[1];
}

void move_nodes(GlobalMesh& mesh, const std::function<Vector3(Vector3)>& map) {
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    const Vector3 x = map(mesh.position(node));
    std::copy(x.begin(), x.end(), &mesh.coordinates[static_cast<std::size_t>(3 * node)]);
  }
}

constexpr double tolerance = 1e-13;

TEST(ElementStiffness, FreeSlabOfBricks) {
  for (const ElementType type : {ElementType::hex8, ElementType::hex8_full}) {
    const auto built =
        build(testing::box_mesh({0, 0, 0}, {3, 2.4, 0.22}, {6, 5, 1}, type), concrete(type));
    EXPECT_EQ(built.stiffness->kinds().bricks, 30);
    EXPECT_EQ(built.stiffness->kinds().other, 0);
    EXPECT_LT(difference_to_assembled(built), tolerance);
  }
}

TEST(ElementStiffness, RowsOfEveryLength) {
  for (int cells = 1; cells <= 9; ++cells) {
    const auto built =
        build(testing::box_mesh({-1, 2, 0}, {0.3 * cells, 0.6, 0.5}, {cells, 2, 2}), concrete());
    EXPECT_LT(difference_to_assembled(built), tolerance) << cells << " cells";
  }
}

TEST(ElementStiffness, ClampedFace) {
  for (const char* face : {"x_min", "z_min"}) {
    GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {2, 1, 1.5}, {7, 4, 5});
    testing::clamp(mesh, face);
    const auto built = build(mesh, concrete());
    EXPECT_EQ(built.stiffness->kinds().bricks, 140);
    EXPECT_LT(difference_to_assembled(built), tolerance);
  }
}

TEST(ElementStiffness, SingleComponentsClamped) {
  GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {2, 1, 1}, {5, 3, 2});
  for (std::size_t i = 0; i < mesh.free_components.size(); ++i) {
    mesh.free_components[i] = static_cast<std::uint8_t>(1 + i % 7);
  }
  EXPECT_LT(difference_to_assembled(build(mesh, concrete())), tolerance);
}

TEST(ElementStiffness, CellsOfTwoSizes) {
  GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {8, 5, 1}, {8, 5, 1});
  move_nodes(mesh, [](Vector3 x) {
    return Vector3{x[0] + (x[0] > 2.5 ? 0.5 : 0), 0.5 * x[1] + (x[1] > 3.5 ? 0.1 : 0), x[2]};
  });
  const auto built = build(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 40);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, NodesListedFromAnotherCorner) {
  GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {6, 5, 1}, {6, 5, 1});
  auto& list = mesh.regions[0].connectivity;
  for (std::size_t e = 0; e < list.size(); e += 16) {  // every second brick, turned about z
    std::rotate(&list[e], &list[e + 1], &list[e + 4]);
    std::rotate(&list[e + 4], &list[e + 5], &list[e + 8]);
  }
  const auto built = build(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 30);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, BricksTurnedInSpace) {
  GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {3, 2, 1}, {7, 5, 2});
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  move_nodes(mesh, [=](Vector3 x) {
    const Vector3 y{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    return Vector3{y[0], c * y[1] - s * y[2], s * y[1] + c * y[2]};
  });
  const auto built = build(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 70);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, ShearedMeshSharesADenseMatrix) {
  GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {3, 2, 1}, {7, 5, 2});
  move_nodes(mesh, [](Vector3 x) { return Vector3{x[0] + 0.3 * x[1], x[1], x[2]}; });
  testing::clamp(mesh, "z_min");
  const auto built = build(mesh, concrete());
  EXPECT_GE(built.stiffness->kinds().congruent, 60);  // small ranks may hold too few of them
  EXPECT_EQ(built.stiffness->kinds().bricks, 0);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, DistortedMesh) {
  GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {4, 3, 2}, {5, 4, 3});
  move_nodes(mesh, [](Vector3 x) {
    return Vector3{x[0] + 0.1 * std::sin(3 * x[1] + x[2]), x[1] + 0.1 * std::cos(2 * x[0] * x[2]),
                   x[2] + 0.05 * std::sin(5 * x[0])};
  });
  const auto built = build(mesh, concrete());
  EXPECT_EQ(built.stiffness->kinds().other, 60);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

/// A slab with a node out of place, and beams along two of its edges.
GlobalMesh slab_with_beams(Structure& structure) {
  GlobalMesh mesh = testing::box_mesh({0, 0, 0}, {6, 5, 0.22}, {9, 7, 1});
  mesh.coordinates[3 * 11] += 0.1;
  ElementSet beams;
  beams.group = "beams";
  beams.region = 1;
  beams.type = ElementType::beam;
  const auto add = [&](GlobalIndex from, GlobalIndex to) {
    beams.tags.push_back(1000 + static_cast<std::int64_t>(beams.tags.size()));
    beams.connectivity.insert(beams.connectivity.end(), {from, to});
    for (const GlobalIndex node : {from, to}) {
      mesh.components[static_cast<std::size_t>(node)] = 0x3f;
    }
  };
  for (GlobalIndex i = 0; i < 9; ++i) add(i, i + 1);
  for (GlobalIndex j = 0; j < 7; ++j) add(10 * j + 9, 10 * j + 19);
  mesh.regions.push_back(beams);
  mesh.free_components = mesh.components;
  Region region = structure.regions[0];
  region.group = "beams";
  region.element = ElementType::beam;
  region.section = Section{"s", 0.09, 6.75e-4, 6.75e-4, 1.1e-3, {0.1, 0.2, 1}};
  structure.regions.push_back(region);
  return mesh;
}

TEST(ElementStiffness, SlabWithBeamsOnItsEdges) {
  Structure structure = concrete();
  const GlobalMesh mesh = slab_with_beams(structure);
  const auto built = build(mesh, structure);
  EXPECT_EQ(built.stiffness->kinds().bricks, 63 - 4);
  EXPECT_EQ(built.stiffness->kinds().other, 4);
  EXPECT_EQ(built.stiffness->kinds().beams, 16);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

TEST(ElementStiffness, SameBitsOnEveryProduct) {
  Structure structure = concrete();
  const GlobalMesh mesh = slab_with_beams(structure);
  const auto built = build(mesh, structure);
  const auto again = build(mesh, structure);
  const std::vector<double> w = random_field(built.mesh, 5);
  std::vector<double> first(w.size(), 1.0);
  std::vector<double> second(w.size(), 2.0);
  std::vector<double> third(w.size(), 3.0);
  built.stiffness->apply(w.data(), first.data());
  built.stiffness->apply(w.data(), second.data());
  again.stiffness->apply(w.data(), third.data());
  EXPECT_EQ(first, second);
  EXPECT_EQ(first, third);
}

/// A structure of fewer nodes than ranks have room for leaves some ranks empty.
TEST(ElementStiffness, OneBrickOnAllRanks) {
  const auto built = build(testing::box_mesh({0, 0, 0}, {1, 2, 3}, {1, 1, 1}), concrete());
  EXPECT_EQ(built.stiffness->kinds().bricks, 1);
  EXPECT_LT(difference_to_assembled(built), tolerance);
}

}  // namespace
}  // namespace pounding
