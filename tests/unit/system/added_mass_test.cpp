#include "system/added_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "elements/rigid_tank.h"
#include "mesh/water_body.h"
#include "support/box_mesh.h"

namespace pounding {
namespace added_mass_test {

using testing_support::box_mesh;

constexpr double density = 1000;

Pool pool() {
  Pool water;
  water.name = "pool";
  water.water = "cells";
  water.density = density;
  return water;
}

/// All nodes of the cells as a structure of its own, with three dofs each, of which `held` none.
Mesh structure_of(const GlobalMesh& cells, const std::vector<char>& held = {}) {
  Mesh mesh;
  mesh.global_nodes = cells.node_count();
  mesh.owned_nodes = static_cast<LocalIndex>(cells.node_count());
  mesh.file_node.resize(cells.node_tags.size());
  std::iota(mesh.file_node.begin(), mesh.file_node.end(), GlobalIndex{0});
  mesh.by_file_node.resize(cells.node_tags.size());
  std::iota(mesh.by_file_node.begin(), mesh.by_file_node.end(), LocalIndex{0});
  mesh.coordinates = cells.coordinates;
  for (std::size_t n = 0; n < cells.node_tags.size(); ++n) {
    mesh.first_dof.push_back(mesh.owned_dofs);
    mesh.free_components.push_back(held.empty() || held[n] == 0 ? 0x07 : 0);
    mesh.owned_dofs += component_count(mesh.free_components.back());
  }
  mesh.dof_count = mesh.owned_dofs;
  return mesh;
}

/// Cells of a box of water, its surface at z = 0, and the nodes of its walls and floor.
struct Box {
  GlobalMesh cells;
  std::vector<GlobalIndex> of_structure;
  WaterBody water;

  Box(const Vector3& size, const std::array<int, 3>& count)
      : cells(box_mesh({0, 0, -size[2]}, size, count, ElementType::hex8_full)) {
    for (GlobalIndex n = 0; n < cells.node_count(); ++n) {
      const Vector3 x = cells.position(n);
      const bool inside = x[0] > 1e-9 && x[0] < size[0] - 1e-9 && x[1] > 1e-9 &&
                          x[1] < size[1] - 1e-9 && x[2] > -size[2] + 1e-9;
      of_structure.push_back(inside ? -1 : n);
    }
    water = join_water(pool(), cells, of_structure);
  }
};

std::vector<double> along(const Mesh& mesh, int direction) {
  std::vector<double> motion(mesh.owned_dofs, 0.0);
  for (LocalIndex n = 0; n < mesh.owned_nodes; ++n) {
    if (const LocalIndex dof = mesh.dof(n, direction); dof >= 0) motion[dof] = 1;
  }
  return motion;
}

std::vector<double> field_of(const AddedMass& added, const std::vector<double>& owned) {
  std::vector<double> field(AddedMass::width * added.nodes().size(), 0.0);
  for (std::size_t n = 0; n < added.nodes().size(); ++n) {
    const NodeDofs& node = added.nodes()[n];
    std::copy_n(&owned[node.begin], node.count, &field[AddedMass::width * n]);
  }
  return field;
}

/// A rectangular rigid tank: the impulsive mass of the series, with the second order, and all of the
/// mass upwards; the ground's load is that of its motion.
TEST(AddedMass, IsTheImpulsiveMassOfARigidTank) {
  const Vector3 size{6, 2, 3};
  const double mass = density * size[0] * size[1] * size[2];
  const double known = mass * water_in_tank(size[2], size[0], 9.81, 1).impulsive.mass;
  EXPECT_NEAR(known / mass, 0.5, 1e-4);
  std::vector<double> errors;
  for (const int n : {3, 6, 12}) {
    const Box box(size, {2 * n, 2, n});
    EXPECT_NEAR(box.water.outline.volume * density / mass, 1, 1e-12);
    const Mesh mesh = structure_of(box.cells);
    const std::vector<double> own(mesh.owned_dofs, 50.0);
    const AddedMass added(mesh, box.water, own);
    errors.push_back(added.added_product(along(mesh, 0).data()) / known - 1);
    EXPECT_NEAR(added.added_product(along(mesh, 2).data()) / mass, 1, 1e-6);
    for (const int d : {0, 1, 2}) {
      double load = 0;
      for (std::size_t i = 0; i < added.nodes().size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
          load += added.ground_force(static_cast<std::size_t>(d))[i][c] *
                  along(mesh, d)[static_cast<std::size_t>(added.nodes()[i].begin) + c];
        }
      }
      EXPECT_NEAR(load / added.added_product(along(mesh, d).data()), 1, 1e-6);
    }
  }
  EXPECT_LT(std::abs(errors[2]), 4e-3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.3);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.3);
}

/// Two coaxial cylinders, their lower halves below a free surface at their axis, heaving: p = 0 there
/// by symmetry, so that the masses are half of those of whole cylinders, known in closed form.
TEST(AddedMass, CouplesCoaxialCylinders) {
  constexpr double r1 = 1, r2 = 1.6, length = 0.5;
  constexpr int around = 48, across = 8;
  GlobalMesh cells = box_mesh({0, 0, 0}, {1, 1, 1}, {around, 1, across}, ElementType::hex8_full);
  for (GlobalIndex n = 0; n < cells.node_count(); ++n) {
    double* const x = &cells.coordinates[static_cast<std::size_t>(3 * n)];
    const double angle = std::numbers::pi * (1 + x[0]);
    const double radius = r2 - (r2 - r1) * x[2];
    const double y = x[1] * length;
    x[0] = radius * std::cos(angle);
    x[1] = y;
    x[2] = radius * std::sin(angle);
  }
  std::vector<GlobalIndex> all(cells.node_tags.size());
  std::iota(all.begin(), all.end(), GlobalIndex{0});
  const Mesh mesh = structure_of(cells);
  const std::vector<double> own(mesh.owned_dofs, 30.0);
  const AddedMass added(mesh, join_water(pool(), cells, all), own);
  const auto heave = [&](double inner, double outer) {
    std::vector<double> motion(mesh.owned_dofs, 0.0);
    for (LocalIndex n = 0; n < mesh.owned_nodes; ++n) {
      const Vector3 x = mesh.position(n);
      const double radius = std::hypot(x[0], x[2]);
      if (std::abs(radius - r1) < 1e-9) motion[mesh.dof(n, 2)] = inner;
      if (std::abs(radius - r2) < 1e-9) motion[mesh.dof(n, 2)] = outer;
    }
    return 2 * added.added_product(motion.data()) / length;
  };
  const double scale = density * std::numbers::pi / (r2 * r2 - r1 * r1);
  const double m11 = scale * r1 * r1 * (r2 * r2 + r1 * r1);
  const double m12 = -2 * scale * r1 * r1 * r2 * r2;
  const double m22 = scale * r2 * r2 * (r2 * r2 + r1 * r1);
  EXPECT_NEAR(heave(1, 0) / m11, 1, 0.01);
  EXPECT_NEAR(heave(0, 1) / m22, 1, 0.01);
  EXPECT_NEAR((heave(1, 1) - heave(1, 0) - heave(0, 1)) / 2 / m12, 1, 0.01);
}

/// Solutions, halves, entries and products are of one matrix, with masses of all sizes, held nodes
/// and so many nodes that tiles are products.
TEST(AddedMass, IsOneMatrixInAllItsForms) {
  const Box box({3, 2, 2}, {10, 7, 7});
  std::vector<char> held(box.of_structure.size(), 0);
  for (std::size_t n = 0; n < held.size(); ++n) {
    held[n] = box.cells.coordinates[3 * n] < 1e-9 ? 1 : 0;
  }
  const Mesh mesh = structure_of(box.cells, held);
  std::vector<double> own;
  for (LocalIndex i = 0; i < mesh.owned_dofs; ++i) own.push_back(20 + 15 * std::sin(1.7 * i));
  const AddedMass added(mesh, box.water, own);
  ASSERT_GT(added.nodes().size(), 128);
  const std::size_t n = own.size();
  std::vector<double> mass(n * n, 0.0);
  for (const auto& [row, column, value] : added.mass_entries()) {
    mass[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)] += value;
  }
  std::vector<double> v(n, 0.0);
  for (const NodeDofs& node : added.nodes()) {
    for (int c = 0; c < node.count; ++c) v[node.begin + c] = std::cos(2.3 * (node.begin + c));
  }
  std::vector<double> force(n, 0.0);
  double product = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) force[i] += mass[i * n + j] * v[j];
    product += v[i] * force[i];
    force[i] += own[i] * v[i];
  }
  EXPECT_NEAR(added.added_product(v.data()) / product, 1, 1e-11);
  const std::vector<double> known = field_of(added, v);
  std::vector<double> x = field_of(added, force);
  added.solve(x.data());
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], known[k], 1e-11);
  x = field_of(added, force);
  added.solve_half(x.data());
  added.solve_transposed_half(x.data());
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], known[k], 1e-11);
}

}  // namespace added_mass_test
}  // namespace pounding
