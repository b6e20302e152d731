#include "system/rigid_body.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "system/coupled_mass.h"

namespace pounding {
namespace rigid_body_test {

/// A mesh of free nodes alone: `components` of each, at places that are given.
Mesh mesh_of(const std::vector<Vector3>& places, const std::vector<std::uint8_t>& components) {
  Mesh mesh;
  for (std::size_t n = 0; n < places.size(); ++n) {
    mesh.file_node.push_back(static_cast<GlobalIndex>(n));
    mesh.coordinates.insert(mesh.coordinates.end(), places[n].begin(), places[n].end());
    mesh.free_components.push_back(components[n]);
    mesh.first_dof.push_back(mesh.dof_count);
    mesh.dof_count += component_count(components[n]);
  }
  mesh.owned_nodes = static_cast<LocalIndex>(places.size());
  mesh.owned_dofs = mesh.dof_count;
  return mesh;
}

std::vector<double> masses(std::size_t count) {
  std::vector<double> mass(count);
  for (std::size_t i = 0; i < count; ++i) mass[i] = 1 + 0.3 * static_cast<double>(i % 7);
  return mass;
}

/// Forces to changes of velocity over all dofs.
std::vector<double> response(const CoupledMass& mass, std::vector<double> force) {
  std::vector<double> field(mass.field_size());
  mass.take(force.data(), field.data());
  mass.solve(field.data());
  mass.put(field.data(), force.data());
  return force;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

const std::vector<Vector3> four{{0, 0, 0}, {2, 0, 0.5}, {0, 3, 1}, {5, 1, 2}};

CoupledMass body_of(Mesh mesh, const std::vector<double>& mass, std::uint8_t components,
                    std::vector<LocalIndex> nodes) {
  const auto count = static_cast<GlobalIndex>(nodes.size());
  mesh.rigid_rows.assign(mesh.free_components.size(), components);
  const RigidPart part{"g", RigidKind::body, components, count, std::move(nodes)};
  std::vector<RigidBody> bodies;
  bodies.emplace_back(mesh, part, mass);
  return {mass, {}, std::move(bodies)};
}

TEST(RigidBody, AnswersForcesAsNewtonSays) {
  // A force off the centre of mass: u'' = F / m there, turned by the inertia about it.
  const Mesh mesh = mesh_of({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {7, 7, 7, 7});
  const std::vector<double> mass(12, 2.0);
  const CoupledMass body = body_of(mesh, mass, 0x3f, {0, 1, 2, 3});
  EXPECT_EQ(body.bodies()[0].motions(), 6U);
  std::vector<double> force(12, 0.0);
  force[2] = 3;  // along z at x = -1
  const std::vector<double> change = response(body, force);
  const double mean = 3.0 / 8;        // F / m
  const double turn = 3.0 / (2 + 2);  // of the masses at x = -1 and 1, about y
  EXPECT_NEAR(change[2], mean + turn, 1e-14);
  EXPECT_NEAR(change[5], mean - turn, 1e-14);
  EXPECT_NEAR(change[8], mean, 1e-14);
  EXPECT_NEAR(change[11], mean, 1e-14);
}

TEST(RigidBody, IsSymmetricAndDoesWhatItDidOnce) {
  const Mesh mesh = mesh_of(four, {0x3f, 0x07, 0x3f, 0x3f});
  const std::vector<double> mass = masses(static_cast<std::size_t>(mesh.owned_dofs));
  for (const std::uint8_t components : {0x3f, 0x23}) {
    const CoupledMass body = body_of(mesh, mass, components, {0, 1, 3});
    std::vector<double> f(mass.size(), 0.0);
    std::vector<double> g(mass.size(), 0.0);
    for (std::size_t i = 0; i < f.size(); ++i) {
      f[i] = std::sin(1 + 3 * static_cast<double>(i));
      g[i] = std::cos(2 + 5 * static_cast<double>(i));
    }
    // Node 2 belongs to no body: its dofs are none of the field's.
    EXPECT_EQ(body.node_of(mesh.first_dof[2]), -1);
    for (LocalIndex i = mesh.first_dof[2]; i < mesh.first_dof[3]; ++i) f[i] = g[i] = 0;
    const std::vector<double> of_f = response(body, f);
    EXPECT_NEAR(product(g, of_f), product(f, response(body, g)), 1e-13);
    // An admissible motion stays what it is: P M P f = P f.
    std::vector<double> momentum = of_f;
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] *= mass[i];
    const std::vector<double> again = response(body, momentum);
    for (std::size_t i = 0; i < again.size(); ++i) EXPECT_NEAR(again[i], of_f[i], 1e-13);
  }
}

TEST(RigidBody, HalfSolutionsMakeAWholeOne) {
  const Mesh mesh = mesh_of(four, {0x3f, 0x07, 0x3f, 0x3f});
  const std::vector<double> mass = masses(static_cast<std::size_t>(mesh.owned_dofs));
  const CoupledMass body = body_of(mesh, mass, 0x23, {0, 1, 2, 3});
  std::vector<double> field(body.field_size(), 0.0);
  for (std::size_t n = 0; n < 4; ++n) {
    for (int c = 0; c < body.nodes()[n].count; ++c) {
      field[body.offset(n) + static_cast<std::size_t>(c)] =
          std::sin(static_cast<double>(7 * n) + c);
    }
  }
  std::vector<double> whole = field;
  body.solve(whole.data());
  body.solve_half(field.data());
  body.solve_transposed_half(field.data());
  for (std::size_t i = 0; i < field.size(); ++i) EXPECT_NEAR(field[i], whole[i], 1e-14);
}

TEST(RigidBody, HasTheMotionsThatItsNodesSee) {
  const std::vector<double> mass = masses(24);
  const auto motions = [&](const std::vector<Vector3>& places, std::uint8_t at_nodes) {
    const Mesh mesh = mesh_of(places, std::vector<std::uint8_t>(places.size(), at_nodes));
    std::vector<LocalIndex> nodes(places.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    return body_of(mesh, mass, 0x3f, nodes).bodies()[0].motions();
  };
  EXPECT_EQ(motions({{0, 0, 0}, {1, 1, 1}}, 7), 5U);  // not about its line
  EXPECT_EQ(motions({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, 7), 5U);
  EXPECT_EQ(motions({{0, 0, 0}, {1, 1, 1}, {3, 3, 4}}, 7), 6U);
  EXPECT_EQ(motions({{4, 4, 4}}, 7), 3U);
  EXPECT_EQ(motions({{4, 4, 4}}, 0x3f), 6U);
  EXPECT_EQ(motions({{1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6, 1, 0}}, 7), 6U);  // far from the origin
}

}  // namespace rigid_body_test
}  // namespace pounding
