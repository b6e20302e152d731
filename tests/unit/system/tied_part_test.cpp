#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "common/matrix3.h"
#include "mesh/tied_nodes.h"
#include "system/coupled_mass.h"
#include "system/rigid_body.h"

namespace pounding {
namespace tied_part_test {

constexpr std::uint8_t solid = 0x07;
constexpr std::uint8_t shell = 0x3f;

/// Two warped quadrangles and a triangle that share corners, and three nodes at some distance.
struct Scene {
  Structure structure;
  GlobalMesh global;
  Mesh mesh;
  std::vector<double> mass;

  /// Components of the carriers and of the nodes that follow.
  Scene(std::uint8_t carriers, std::uint8_t followers, std::uint8_t clamped = 0) {
    const std::vector<Vector3> places{
        {0, 0, 0},   {2, 0.1, 0.2}, {2.1, 1.9, -0.1}, {0, 2, 0.3},       {4, 0, 0.1},
        {4.2, 2, 0}, {3, 3.5, 0},   {0.7, 0.9, 0.45}, {2.03, 1.1, -0.3}, {3, 2.4, 0.2}};
    structure.name = "t";
    structure.rigid_groups.push_back({RigidKind::tie, "edge", "face"});
    for (std::size_t n = 0; n < places.size(); ++n) {
      global.node_tags.push_back(static_cast<std::int64_t>(n) + 1);
      global.coordinates.insert(global.coordinates.end(), places[n].begin(), places[n].end());
      global.components.push_back(n < 7 ? carriers : followers);
      global.free_components.push_back(global.components.back());
    }
    global.free_components[0] &= static_cast<std::uint8_t>(~clamped);
    global.groups["edge"].nodes = {7, 8, 9};
    global.groups["face"].nodes = {0, 1, 2, 3, 4, 5, 6};
    global.groups["face"].facets = {{{0, 1, 2, 3}, 4}, {{1, 4, 5, 2}, 4}, {{2, 5, 6, -1}, 3}};
    add_tied_nodes(structure, global);
    for (std::size_t n = 0; n < places.size(); ++n) {
      mesh.file_node.push_back(static_cast<GlobalIndex>(n));
      mesh.by_file_node.push_back(static_cast<LocalIndex>(n));
      mesh.first_dof.push_back(mesh.dof_count);
      mesh.dof_count += component_count(global.free_components[n]);
    }
    mesh.coordinates = global.coordinates;
    mesh.free_components = global.free_components;
    mesh.owned_nodes = static_cast<LocalIndex>(places.size());
    mesh.owned_dofs = mesh.dof_count;
    for (LocalIndex i = 0; i < mesh.owned_dofs; ++i) mass.push_back(1 + 0.3 * (i % 7));
  }

  CoupledMass coupled() const {
    std::vector<TiedPart> ties;
    for (const RigidNodes& nodes : global.rigid) {
      RigidPart part;
      part.kind = nodes.kind;
      part.nodes.assign(nodes.nodes.begin(), nodes.nodes.end());
      part.tied = nodes.tied;
      ties.emplace_back(mesh, part, mass);
    }
    return {mass, {}, {}, std::move(ties)};
  }

  /// Displacements of a rigid motion (0-5).
  std::vector<double> motion(std::size_t m) const {
    std::vector<double> u(mass.size());
    for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
      for (int c = 0; c < 6; ++c) {
        const LocalIndex dof = mesh.dof(node, c);
        if (dof < 0) continue;
        u[dof] = rigid_motion_row(static_cast<std::size_t>(c), mesh.position(node))[m];
      }
    }
    return u;
  }
};

/// Forces to changes of velocity over all dofs, those of the tie and others.
std::vector<double> response(const Scene& scene, const std::vector<double>& force) {
  const CoupledMass coupled = scene.coupled();
  std::vector<double> velocity = force;
  for (std::size_t i = 0; i < force.size(); ++i) velocity[i] /= scene.mass[i];
  std::vector<double> field(coupled.field_size());
  coupled.take(force.data(), field.data());
  coupled.solve(field.data());
  coupled.put(field.data(), velocity.data());
  return velocity;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<double> some_force(std::size_t count) {
  std::vector<double> force(count);
  for (std::size_t i = 0; i < count; ++i) force[i] = std::sin(static_cast<double>(3 * i + 1));
  return force;
}

constexpr std::array<std::array<std::uint8_t, 2>, 4> kinds{
    {{solid, solid}, {solid, shell}, {shell, solid}, {shell, shell}}};

TEST(TiedPart, RigidMotionsPassAtAnyDistance) {
  for (const auto& [carriers, followers] : kinds) {
    const Scene scene(carriers, followers);
    for (std::size_t m = 0; m < 6; ++m) {
      // M R of a rigid motion R is answered by R itself, if B holds it.
      const std::vector<double> wanted = scene.motion(m);
      std::vector<double> momentum = wanted;
      for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] *= scene.mass[i];
      const std::vector<double> found = response(scene, momentum);
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-12);
    }
  }
}

TEST(TiedPart, ChangesNeitherMomentumNorAngularMomentum) {
  for (const auto& [carriers, followers] : kinds) {
    const Scene scene(carriers, followers);
    const std::vector<double> force = some_force(scene.mass.size());
    std::vector<double> momentum = response(scene, force);
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] *= scene.mass[i];
    for (std::size_t m = 0; m < 6; ++m) {
      EXPECT_NEAR(product(scene.motion(m), momentum), product(scene.motion(m), force), 1e-12);
    }
  }
}

TEST(TiedPart, IsASymmetricProjection) {
  for (const std::uint8_t clamped : {0x00, 0x05, 0x3f}) {
    for (const auto& [carriers, followers] : kinds) {
      const Scene scene(carriers, followers, static_cast<std::uint8_t>(clamped & carriers));
      const std::vector<double> f = some_force(scene.mass.size());
      std::vector<double> g(f.rbegin(), f.rend());
      const std::vector<double> v = response(scene, f);
      EXPECT_NEAR(product(v, g), product(response(scene, g), f), 1e-13);
      std::vector<double> momentum = v;
      for (std::size_t i = 0; i < v.size(); ++i) momentum[i] *= scene.mass[i];
      const std::vector<double> again = response(scene, momentum);
      for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(again[i], v[i], 1e-13);
      // It moves less than the parts alone.
      double alone = 0;
      for (std::size_t i = 0; i < v.size(); ++i) alone += f[i] * f[i] / scene.mass[i];
      EXPECT_LT(product(v, f), alone);
    }
  }
}

TEST(TiedPart, HalvesMakeTheWhole) {
  for (const auto& [carriers, followers] : kinds) {
    const Scene scene(carriers, followers);
    const CoupledMass coupled = scene.coupled();
    const std::vector<double> f = some_force(scene.mass.size());
    std::vector<double> whole(coupled.field_size());
    coupled.take(f.data(), whole.data());
    std::vector<double> halves = whole;
    coupled.solve(whole.data());
    coupled.solve_half(halves.data());
    const double square = product(halves, halves);
    coupled.solve_transposed_half(halves.data());
    std::vector<double> v(f.size(), 0.0);
    coupled.put(whole.data(), v.data());
    EXPECT_NEAR(square, product(v, f), 1e-13);
    for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(whole[i], halves[i], 1e-13);
  }
}

TEST(TiedPart, NodesOnCornersAreThoseOfAMeshThatMatches) {
  // On a corner of three facets: the mass of both, and the corner's velocity.
  Scene scene(solid, solid);
  std::copy_n(&scene.global.coordinates[6], 3, &scene.global.coordinates[24]);
  scene.global.rigid.clear();
  scene.global.groups["edge"].nodes = {8};
  add_tied_nodes(scene.structure, scene.global);
  ASSERT_EQ(scene.global.rigid.size(), 1U);
  EXPECT_EQ(scene.global.rigid[0].nodes, (std::vector<GlobalIndex>{2, 8}));
  std::vector<double> force(scene.mass.size(), 0.0);
  force[24] = 2;
  const std::vector<double> found = response(scene, force);
  EXPECT_DOUBLE_EQ(found[24], 2 / (scene.mass[24] + scene.mass[6]));
  EXPECT_DOUBLE_EQ(found[6], found[24]);
}

}  // namespace tied_part_test
}  // namespace pounding
