#include "system/mass_scaling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "elements/element_traits.h"
#include "support/refusal.h"
#include "unit/elements/dense_eigen.h"

namespace pounding {
namespace mass_scaling_test {

constexpr std::size_t size = 12;
constexpr Rayleigh damping{0.5, 1.2e-5};

struct Matrices {
  std::vector<double> stiffness;
  std::vector<double> mass;
  double frequency() const { return std::sqrt(largest_eigenvalue(stiffness, mass)); }
};

Matrices matrices_of(ElementType type, const std::vector<double>& x,
                     const ElementProperties& properties) {
  const std::size_t n = element_layout(type).size();
  Matrices result{std::vector<double>(n * n), std::vector<double>(n)};
  element_matrices(type, x, properties, result.stiffness, result.mass);
  return result;
}

/// A short, stiff beam of steel across the axes.
Matrices beam() {
  ElementProperties properties{.young = 200e9,
                               .poisson = 0.3,
                               .density = 7800,
                               .area = 28.48e-4,
                               .inertia_y = 1943e-8,
                               .inertia_z = 142.4e-8,
                               .torsion = 6.98e-8};
  return matrices_of(ElementType::beam, {0, 0, 0, 0.1, 0.05, 0.02}, properties);
}

/// Slivers of concrete: a quadrangle and a triangle of shells, a hexahedron, a tetrahedron.
std::vector<Matrices> slivers() {
  const ElementProperties concrete{
      .young = 30e9, .poisson = 0.2, .density = 2500, .thickness = 0.2};
  return {
      matrices_of(ElementType::shell4, {0, 0, 0, 0.5, 0, 0, 0.5, 0.05, 0, 0, 0.03, 0}, concrete),
      matrices_of(ElementType::shell3, {0, 0, 0, 0.5, 0, 0, 0.2, 0.03, 0}, concrete),
      matrices_of(ElementType::hex8, {0, 0, 0,   1, 0, 0,   1, .6, 0,   0, .5, 0,
                                      0, 0, .05, 1, 0, .04, 1, .6, .05, 0, .5, .05},
                  concrete),
      matrices_of(ElementType::tet4, {0, 0, 0, 1, 0, 0, 0.2, 1, 0, 0.4, 0.3, 0.05}, concrete)};
}

/// The time step at which 4 (M + S) - 2 dt C - dt^2 K of a beam stops being positive semidefinite.
double critical_step(const Matrices& element, const std::vector<double>& added) {
  const std::size_t size = element.mass.size();
  double low = 1e-9;
  double high = 1;
  for (int i = 0; i < 200 && high > low * (1 + 1e-13); ++i) {
    const double dt = std::sqrt(low * high);
    std::vector<double> pencil(size * size);
    for (std::size_t r = 0; r < size; ++r) {
      for (std::size_t c = 0; c < size; ++c) {
        const double k = element.stiffness[r * size + c];
        const double m = r == c ? element.mass[r] : 0;
        pencil[r * size + c] = (4 * (m + added[r * size + c]) -
                                2 * dt * (damping.alpha * m + damping.beta * k) - dt * dt * k) /
                               std::sqrt(element.mass[r] * element.mass[c]);
      }
    }
    const double smallest = testing_support::symmetric_eigenvalues(std::move(pencil), size).front();
    (smallest > 0 ? low : high) = dt;
  }
  return low;
}

void expect_exactly_the_wanted_step(const Matrices& element) {
  const std::size_t entries = element.stiffness.size();
  const double own = critical_step(element, std::vector<double>(entries, 0.0));
  const double square = element.frequency() * element.frequency();
  EXPECT_NEAR(own / critical_time_step(damping.alpha + damping.beta * square, square), 1, 1e-9);
  for (const double part : {0.999, 1.5, 5.0, 20.0}) {
    std::vector<double> added(entries, 0.0);
    const double factor =
        add_element_mass(part * own, damping, element.stiffness, element.mass, added);
    EXPECT_EQ(factor > 0, part > 1);
    EXPECT_NEAR(critical_step(element, added) / (std::max(1.0, part) * own), 1, 1e-8) << part;
  }
}

TEST(MassScaling, GivesAnElementExactlyTheWantedStep) {
  expect_exactly_the_wanted_step(beam());
  for (const Matrices& sliver : slivers()) expect_exactly_the_wanted_step(sliver);
}

TEST(MassScaling, LeavesAnElementAloneThatAllowsTheStep) {
  const Matrices element = beam();
  std::vector<double> added(size * size, 0.0);
  const std::vector<double> none(size * size, 0.0);
  const double own = critical_step(element, none);
  EXPECT_EQ(add_element_mass(0.999 * own, damping, element.stiffness, element.mass, added), 0);
  EXPECT_EQ(added, none);
}

TEST(MassScaling, DoesNotMoveARigidBody) {
  const Matrices element = beam();
  std::vector<double> added(size * size, 0.0);
  add_element_mass(2e-5, damping, element.stiffness, element.mass, added);
  double largest = 0;
  for (const double entry : added) {
    largest = std::max(largest, std::abs(entry));
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(added[i * size + d] + added[i * size + d + 6], 0, 1e-13 * largest);
    }
  }
}

TEST(MassScaling, OfASpringIsThatOfAnImplicitOne) {
  constexpr double dt = 1e-3;
  const std::vector<double> stiffness{5e7, -5e7, -5e7, 5e7};
  const std::vector<double> mass{0, 0};
  std::vector<double> added(4, 0.0);
  const double factor = add_element_mass(dt, {0, 2e-4}, stiffness, mass, added);
  EXPECT_DOUBLE_EQ(factor, dt / 4 * (4e-4 + dt));
  // 4 S = 2 dt C + dt^2 K with C = beta K.
  EXPECT_NEAR(4 * added[0], 2 * dt * 2e-4 * 5e7 + dt * dt * 5e7, 1e-10);
  EXPECT_DOUBLE_EQ(added[1], -added[0]);
}

/// Two bars in line, the first five times as stiff, and a third apart from them.
GlobalMesh three_bars() {
  GlobalMesh mesh;
  for (const double x : {0.0, 1.0, 2.0, 5.0, 6.0}) {
    mesh.node_tags.push_back(static_cast<std::int64_t>(mesh.node_tags.size()) + 1);
    mesh.coordinates.insert(mesh.coordinates.end(), {x, 0, 0});
  }
  for (int region = 0; region < 2; ++region) {
    ElementSet set;
    set.region = region;
    set.type = ElementType::bar;
    set.tags = {1, 2};
    set.connectivity =
        region == 0 ? std::vector<GlobalIndex>{0, 1, 3, 4} : std::vector<GlobalIndex>{1, 2, 2, 1};
    mesh.regions.push_back(set);
  }
  mesh.components.assign(5, 0x07);
  mesh.free_components = mesh.components;
  return mesh;
}

Structure bars_of(double time_step) {
  Structure structure;
  structure.name = "bars";
  structure.mass_scaling = time_step;
  for (const double young : {5e10, 1e10}) {
    Region region;
    region.group = young > 2e10 ? "stiff" : "soft";
    region.element = ElementType::bar;
    region.material = {"steel", young, 0.3, 8000};
    region.area = 1;
    structure.regions.push_back(region);
  }
  return structure;
}

std::vector<std::vector<GlobalIndex>> groups(double time_step, const GlobalMesh& mesh) {
  std::vector<std::vector<GlobalIndex>> result;
  for (const NodeCluster& cluster : coupled_nodes(bars_of(time_step), mesh, 3)) {
    EXPECT_EQ(cluster.structure, 3);
    result.push_back(cluster.nodes);
  }
  return result;
}

TEST(MassScaling, GroupsNodesOfScaledElements) {
  // A bar of 1 m between free ends: omega = 2 c, critical step 1 / c = 4e-4 s and 8.9e-4 s.
  using Groups = std::vector<std::vector<GlobalIndex>>;
  GlobalMesh mesh = three_bars();
  EXPECT_EQ(groups(0, mesh), Groups{});
  EXPECT_EQ(groups(3.9e-4, mesh), Groups{});
  EXPECT_EQ(groups(4.1e-4, mesh), (Groups{{0, 1}, {3, 4}}));
  EXPECT_EQ(groups(1e-3, mesh), (Groups{{0, 1, 2}, {3, 4}}));
  mesh.free_components[1] = 0;  // clamped: connects nothing
  EXPECT_EQ(groups(1e-3, mesh), (Groups{{0}, {2}, {3, 4}}));
}

TEST(MassScaling, RefusesAStepThatAlphaAloneForbids) {
  Structure structure = bars_of(1e-3);
  structure.damping.alpha = 2100;
  EXPECT_EQ(testing_support::refusal_of([&] { coupled_nodes(structure, three_bars(), 0); }),
            "option -bars_mass_scaling 0.001 s: the damping alpha = 2100 1/s of group stiff "
            "allows no step above 0.000952381 s; ask for a smaller one");
}

/// Bars along the lines of a square grid of n x n nodes.
GlobalMesh grid_of_bars(GlobalIndex n) {
  GlobalMesh mesh;
  ElementSet set;
  set.type = ElementType::bar;
  const auto add = [&](GlobalIndex a, GlobalIndex b) {
    set.tags.push_back(static_cast<std::int64_t>(set.tags.size()) + 1);
    set.connectivity.insert(set.connectivity.end(), {a, b});
  };
  for (GlobalIndex node = 0; node < n * n; ++node) {
    mesh.node_tags.push_back(node + 1);
    mesh.coordinates.insert(mesh.coordinates.end(),
                            {static_cast<double>(node % n), static_cast<double>(node / n), 0});
    if (node % n > 0) add(node - 1, node);
    if (node >= n) add(node - n, node);
  }
  mesh.regions.push_back(set);
  mesh.components.assign(mesh.node_tags.size(), 0x07);
  mesh.free_components = mesh.components;
  return mesh;
}

TEST(MassScaling, RefusesAGroupWhoseFactorIsTooLarge) {
  const GlobalMesh grid = grid_of_bars(30);
  const std::size_t edges = grid.regions[0].tags.size();
  for (const std::size_t most : {std::size_t{10}, edges}) {
    EXPECT_NO_THROW(coupled_nodes(bars_of(3e-4), grid, 0, most));  // nothing is scaled
    EXPECT_THROW(coupled_nodes(bars_of(1e-3), grid, 0, most), UserError);
  }
  EXPECT_NO_THROW(coupled_nodes(bars_of(1e-3), grid, 0, 10 * edges));
}

TEST(MassScaling, TakesManyDofsWhoseFactorIsSmall) {
  const GlobalMesh grid = grid_of_bars(100);  // 30,000 dofs
  const auto clusters = coupled_nodes(bars_of(1e-3), grid, 0);
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(clusters[0].nodes.size(), 10000u);
}

}  // namespace mass_scaling_test
}  // namespace pounding
