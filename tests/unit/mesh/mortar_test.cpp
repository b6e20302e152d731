#include "mesh/mortar.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/matrix3.h"
#include "mesh/tied_nodes.h"

namespace pounding {
namespace mortar_test {

/// A face of m x n cells on the unit square.
struct Grid {
  int m = 1, n = 1;
  bool triangles = false;
  double distortion = 0;  ///< of nodes inside, parts of a cell
};

/// Two faces, on each other or apart; the second follows the first.
struct Scene {
  Structure structure;
  GlobalMesh mesh;

  Scene(const Grid& followed, const Grid& following, double apart = 0, double size = 1,
        const Vector3& shift = {0, 0, 0}) {
    structure.name = "t";
    structure.rigid_groups.push_back({RigidKind::tie, "edge", "face"});
    add("face", followed, {0, 0, 0}, 1);
    add("edge", following, {shift[0], shift[1], apart}, size);
  }

  void add(const std::string& name, const Grid& grid, const Vector3& origin, double size) {
    const auto first = static_cast<GlobalIndex>(mesh.node_tags.size());
    NodeGroup& group = mesh.groups[name];
    for (int j = 0; j <= grid.n; ++j) {
      for (int i = 0; i <= grid.m; ++i) {
        const bool inside = i > 0 && j > 0 && i < grid.m && j < grid.n;
        const double off = inside ? grid.distortion : 0;
        const double x = (i + off * std::sin(3.0 * i + 7.0 * j)) / grid.m * size;
        const double y = (j + off * std::cos(5.0 * i + 2.0 * j)) / grid.n * size;
        const Vector3 place = turned({origin[0] + x, origin[1] + y, origin[2]});
        group.nodes.push_back(static_cast<GlobalIndex>(mesh.node_tags.size()));
        mesh.node_tags.push_back(group.nodes.back() + 1);
        mesh.coordinates.insert(mesh.coordinates.end(), place.begin(), place.end());
        mesh.components.push_back(0x07);
        mesh.free_components.push_back(0x07);
      }
    }
    for (int j = 0; j < grid.n; ++j) {
      for (int i = 0; i < grid.m; ++i) {
        const GlobalIndex a = first + j * (grid.m + 1) + i;
        const GlobalIndex d = a + grid.m + 1;
        if (grid.triangles) {
          group.facets.push_back({{a, a + 1, d + 1, -1}, 3});
          group.facets.push_back({{a, d, d + 1, -1}, 3});
        } else {
          group.facets.push_back({{a, a + 1, d + 1, d}, 4});
        }
      }
    }
  }

  /// Into a plane along no axis.
  static Vector3 turned(const Vector3& x) {
    const Vector3 a = normalised({1, 2, 0.5});
    const Vector3 b = normalised(cross(a, {0.3, -0.2, 1}));
    const Vector3 c = cross(a, b);
    Vector3 place{};
    for (std::size_t d = 0; d < 3; ++d) place[d] = x[0] * a[d] + x[1] * b[d] + x[2] * c[d];
    return place;
  }

  std::vector<TiedNode> rows() {
    add_tied_nodes(structure, mesh);
    std::vector<TiedNode> all;
    for (const RigidNodes& part : mesh.rigid) {
      all.insert(all.end(), part.tied.begin(), part.tied.end());
    }
    return all;
  }

  /// Force on every node of a face under a traction of 1: two points per direction are exact.
  std::vector<double> forces(const std::string& name) const {
    std::vector<double> force(mesh.node_tags.size(), 0.0);
    for (const Facet& facet : mesh.groups.at(name).facets) {
      const std::vector<Vector3> x = corners_of(mesh, facet);
      if (facet.count == 3) {
        const double area = norm(cross(minus(x[1], x[0]), minus(x[2], x[0]))) / 2;
        for (const GlobalIndex node : facet.corners()) force[node] += area / 3;
        continue;
      }
      for (const double s : {-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}) {
        for (const double t : {-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}) {
          const double shares[4] = {(1 - s) * (1 - t) / 4, (1 + s) * (1 - t) / 4,
                                    (1 + s) * (1 + t) / 4, (1 - s) * (1 + t) / 4};
          Vector3 a{0, 0, 0};
          Vector3 b{0, 0, 0};
          for (std::size_t d = 0; d < 3; ++d) {
            a[d] = ((1 - t) * (x[1][d] - x[0][d]) + (1 + t) * (x[2][d] - x[3][d])) / 4;
            b[d] = ((1 - s) * (x[3][d] - x[0][d]) + (1 + s) * (x[2][d] - x[1][d])) / 4;
          }
          for (std::size_t i = 0; i < 4; ++i)
            force[facet.nodes[i]] += shares[i] * norm(cross(a, b));
        }
      }
    }
    return force;
  }
};

/// Largest error of what corners get of a traction, over the largest force of one.
double force_error(Scene scene) {
  const std::vector<TiedNode> rows = scene.rows();
  const std::vector<double> own = scene.forces("edge");
  std::vector<double> left = scene.forces("face");
  double largest = 0;
  for (const double force : left) largest = std::max(largest, force);
  for (const TiedNode& tied : rows) {
    for (const Carrier& carrier : tied.carriers) {
      left[carrier.node] -= own[tied.node] * carrier.block[0];
      EXPECT_NEAR(carrier.block[7], carrier.block[0], 1e-15);
      EXPECT_NEAR(carrier.block[14], carrier.block[0], 1e-15);
      EXPECT_NEAR(carrier.block[1], 0, 1e-15);
    }
  }
  double worst = 0;
  for (const double force : left) worst = std::max(worst, std::abs(force));
  return worst / largest;
}

/// Largest error of nodes that follow a motion that is linear in the place.
double linear_error(Scene scene) {
  double worst = 0;
  for (const TiedNode& tied : scene.rows()) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t d = 0; d < 3; ++d) {
        double found = 0;
        for (const Carrier& carrier : tied.carriers) {
          found += carrier.block[7 * k] * (1 + scene.mesh.position(carrier.node)[d]);
        }
        worst = std::max(worst, std::abs(found - 1 - scene.mesh.position(tied.node)[d]));
      }
    }
  }
  return worst;
}

TEST(Mortar, PassesAConstantTractionOfAnyFlatMeshes) {
  for (const Grid& followed :
       {Grid{3, 3}, Grid{4, 2}, Grid{1, 1}, Grid{3, 4, true}, Grid{4, 4, true, 0.2}}) {
    for (const Grid& following :
         {Grid{4, 5}, Grid{2, 2}, Grid{3, 3, true}, Grid{5, 2, true, 0.25}}) {
      const Scene scene(followed, following);
      EXPECT_LT(force_error(scene), 1e-13);
      EXPECT_LT(linear_error(scene), 1e-13);
    }
  }
}

TEST(Mortar, PassesItOfDistortedQuadrangles) {
  for (const Grid& following : {Grid{4, 5, false, 0.2}, Grid{4, 5, true, 0.2}}) {
    const Scene scene({3, 3, false, 0.2}, following);
    EXPECT_LT(force_error(scene), 1e-10);
    EXPECT_LT(linear_error(scene), 1e-13);
  }
}

TEST(Mortar, FollowsRigidMotionsAtADistance) {
  for (const double size : {1.0, 1.1}) {
    Scene scene({3, 3, false, 0.2}, {4, 5, true, 0.2}, 0.1, size);
    for (const TiedNode& tied : scene.rows()) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto wanted = rigid_motion_row(i, scene.mesh.position(tied.node));
        for (std::size_t m = 0; m < 6; ++m) {
          double found = 0;
          for (const Carrier& carrier : tied.carriers) {
            for (std::size_t j = 0; j < 3; ++j) {
              found += carrier.block[6 * i + j] *
                       rigid_motion_row(j, scene.mesh.position(carrier.node))[m];
            }
          }
          EXPECT_NEAR(found, wanted[m], 1e-12);
        }
      }
    }
  }
}

TEST(Mortar, ConstantCurvatureOfShellsIsFollowedExactly) {
  Scene scene({3, 3}, {4, 5}, 0.05);
  for (auto* const components : {&scene.mesh.components, &scene.mesh.free_components}) {
    std::ranges::fill(*components, 0x3f);
  }
  const Vector3 a = Scene::turned({1, 0, 0});
  const Vector3 b = Scene::turned({0, 1, 0});
  const Vector3 n = Scene::turned({0, 0, 1});
  // w = x^2 - 2 y^2 + x y / 2 with the turns of its slopes; at a height the turns shift as well.
  const auto motion = [&](const Vector3& at) {
    const double x = dot(at, a);
    const double y = dot(at, b);
    const double turn_a = -4 * y + x / 2;
    const double turn_b = -2 * x - y / 2;
    const double w = x * x - 2 * y * y + x * y / 2;
    std::array<double, 6> u{};
    for (std::size_t d = 0; d < 3; ++d) {
      u[d] = w * n[d] + dot(at, n) * (turn_b * a[d] - turn_a * b[d]);
      u[3 + d] = turn_a * a[d] + turn_b * b[d];
    }
    return u;
  };
  for (const TiedNode& tied : scene.rows()) {
    const std::array<double, 6> wanted = motion(scene.mesh.position(tied.node));
    for (std::size_t i = 0; i < 6; ++i) {
      double found = 0;
      for (const Carrier& carrier : tied.carriers) {
        const std::array<double, 6> u = motion(scene.mesh.position(carrier.node));
        for (std::size_t j = 0; j < 6; ++j) found += carrier.block[6 * i + j] * u[j];
      }
      EXPECT_NEAR(found, wanted[i], 1e-13);
    }
  }
}

/// Whether rows are those of nodes without facets, which follow where they are, to the last bit.
std::vector<bool> is_at_place(Scene scene) {
  Scene alone = scene;
  alone.mesh.groups["edge"].facets.clear();
  const std::vector<TiedNode> found = scene.rows();
  const std::vector<TiedNode> wanted = alone.rows();
  std::vector<bool> same;
  for (std::size_t i = 0; i < found.size(); ++i) {
    same.push_back(std::ranges::equal(
        found[i].carriers, wanted[i].carriers,
        [](const Carrier& a, const Carrier& b) { return a.node == b.node && a.block == b.block; }));
  }
  return same;
}

TEST(Mortar, NodesOfNestedMeshesFollowAtTheirPlaces) {
  for (const Grid& following : {Grid{2, 3}, Grid{4, 3}, Grid{6, 9}}) {
    for (const bool same : is_at_place({{2, 3}, following})) EXPECT_TRUE(same);
  }
}

TEST(Mortar, TakesTheNearerOfTwoFacesBehindEachOther) {
  Scene scene({3, 3}, {4, 5});
  scene.add("face", {2, 2}, {0, 0, -0.05}, 1);
  for (const TiedNode& tied : scene.rows()) {
    for (const Carrier& carrier : tied.carriers) EXPECT_LT(carrier.node, 16);
  }
  EXPECT_TRUE(scene.mesh.doubts.empty());
}

TEST(Mortar, CoveredPartsOfFacetsPassTheirShare) {
  // A strip of 1/30 of the second face is beside the first, 1/6 of its last cells.
  Scene scene({3, 3}, {5, 5}, 0, 1, {1.0 / 30, 0, 0});
  EXPECT_LT(linear_error(scene), 1e-13);
  const std::vector<TiedNode> rows = scene.rows();
  EXPECT_EQ(scene.mesh.doubts.size(), 1U);
  for (const TiedNode& tied : rows) {
    double largest = 0;
    for (const Carrier& carrier : tied.carriers) {
      largest = std::max(largest, std::abs(carrier.block[0]));
    }
    EXPECT_LT(largest, 1.5);
  }
}

TEST(Mortar, NodesMostlyBesideFollowAtTheirPlaces) {
  // A third of the second face is beside the first.
  const std::vector<bool> same = is_at_place({{3, 3}, {4, 4}, 0, 1, {0.3, 0, 0}});
  ASSERT_EQ(same.size(), 25U);
  for (std::size_t i = 0; i < same.size(); ++i) EXPECT_EQ(same[i], i % 5 >= 3) << i;
}

TEST(Mortar, WhatIsClampedOnAPlaneOfSymmetryFollowsThatPlane) {
  Scene scene({3, 3}, {2, 2});
  for (const char* const name : {"face", "edge"}) {
    const int nodes = std::string(name) == "face" ? 4 : 3;
    const GlobalIndex first = scene.mesh.groups[name].nodes.front();
    for (int i = 0; i < nodes; ++i) scene.mesh.free_components[first + i] = 0x05;
  }
  for (const TiedNode& tied : scene.rows()) {
    if (scene.mesh.free_components[tied.node] == 0x07) continue;
    double across = 0;
    for (const Carrier& carrier : tied.carriers) {
      if (carrier.node < 4) continue;
      EXPECT_EQ(carrier.block[7], 0);
      across = std::max(across, std::abs(carrier.block[0]));
    }
    EXPECT_GT(across, 0.01);  // other components follow by means
  }
}

}  // namespace mortar_test
}  // namespace pounding
