#pragma once

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "elements/element_traits.h"
#include "mesh/element_properties.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"
#include "support/box_mesh.h"
#include "system/finite_element_system.h"
#include "unit/elements/dense_eigen.h"

/// Small structures damped differently from region to region, and their dense matrices.
namespace pounding::testing_support {

struct DampedStructure {
  GlobalMesh mesh;
  Structure structure;
};

/// A set of elements and its region in one go.
inline Region& add_region(DampedStructure& damped, const std::string& group, ElementType type,
                          std::vector<GlobalIndex> connectivity) {
  ElementSet set;
  set.group = group;
  set.region = static_cast<int>(damped.structure.regions.size());
  set.type = type;
  set.connectivity = std::move(connectivity);
  const auto nodes = static_cast<std::size_t>(element_layout(type).nodes);
  for (std::size_t e = 0; e < set.connectivity.size() / nodes; ++e) {
    set.tags.push_back(static_cast<std::int64_t>(e) + 1);
  }
  damped.mesh.regions.push_back(std::move(set));
  Region region;
  region.group = group;
  region.element = type;
  damped.structure.regions.push_back(region);
  return damped.structure.regions.back();
}

/// Hexahedra of three materials and dampings at random, on springs with dashpots, with masses.
inline DampedStructure random_structure(unsigned seed) {
  std::mt19937 random(seed);
  // 10^x, x uniform: whatever the library, the same numbers.
  const auto about = [&random](double low, double high) {
    const double part = static_cast<double>(random()) / 4294967296.0;
    return low * std::pow(high / low, part);
  };
  DampedStructure damped;
  damped.mesh = box_mesh({0, 0, 0}, {2.5, about(0.5, 3), about(0.2, 2)}, {3, 2, 2});
  const std::vector<GlobalIndex> bricks = damped.mesh.regions[0].connectivity;
  damped.mesh.regions.clear();
  damped.structure.name = "body";
  damped.structure.damping = {about(0.1, 100), about(1e-7, 1e-4)};
  std::array<std::vector<GlobalIndex>, 3> parts;
  for (std::size_t e = 0; e < bricks.size() / 8; ++e) {
    auto& part = parts[e < 3 ? e : random() % 3];
    part.insert(part.end(), bricks.begin() + static_cast<std::ptrdiff_t>(8 * e),
                bricks.begin() + static_cast<std::ptrdiff_t>(8 * e + 8));
  }
  for (std::size_t p = 0; p < 3; ++p) {
    Region& region = add_region(damped, "part" + std::to_string(p), ElementType::hex8, parts[p]);
    region.material = {"solid", about(1e9, 1e11), 0.2, about(500, 8000)};
    if (p > 0) {
      region.damping = Rayleigh{about(1e-2, 1e4), about(1e-8, 1e-3)};
    }
  }
  const GlobalIndex last = damped.mesh.node_count() - 1;
  Region& supports = add_region(damped, "support", ElementType::grounded_spring, {0, 1, 2, 3, 4});
  supports.stiffness = {about(1e5, 1e10), about(1e5, 1e10), about(1e5, 1e10)};
  supports.dashpot = {about(1e2, 1e7), about(1e2, 1e7), 0};
  supports.damping = Rayleigh{0, 0};
  Region& link = add_region(damped, "link", ElementType::spring, {0, last, 5, last - 1});
  link.stiffness = {about(1e5, 1e9), 0, about(1e5, 1e9)};
  link.dashpot = {0, about(1e2, 1e6), 0};
  Region& masses = add_region(damped, "mass", ElementType::point_mass, {last, last - 4});
  masses.mass = about(1, 1000);
  masses.damping = Rayleigh{about(1, 1000), 0};
  clamp(damped.mesh, "z_max");
  return damped;
}

/// M (diagonal), K and C = sum over regions of alpha M + beta K over the free dofs. Dashpots are links
/// and in none of them.
struct DenseSystem {
  std::map<std::pair<GlobalIndex, int>, std::size_t> dof;  ///< of node and component
  std::vector<double> mass;
  std::vector<double> stiffness;  ///< shape (n, n)
  std::vector<double> damping;    ///< shape (n, n)
};

/// Places of the nodes of an element and of its displacements among the free dofs.
struct PlacedElement {
  std::vector<double> x;          ///< positions of its nodes, one after the other [m]
  std::vector<std::size_t> dofs;  ///< of its displacements; the number of dofs where clamped
};

inline PlacedElement placed_element(const GlobalMesh& mesh, const ElementSet& set, std::size_t e,
                                    const DenseSystem& dense) {
  const auto nodes = static_cast<std::size_t>(element_layout(set.type).nodes);
  PlacedElement element;
  for (std::size_t a = 0; a < nodes; ++a) {
    const GlobalIndex node = set.connectivity[e * nodes + a];
    const Vector3 position = mesh.position(node);
    element.x.insert(element.x.end(), position.begin(), position.end());
    for (int c = 0; c < 3; ++c) {
      const auto found = dense.dof.find({node, c});
      element.dofs.push_back(found == dense.dof.end() ? dense.dof.size() : found->second);
    }
  }
  return element;
}

/// For elements with displacements only.
inline DenseSystem dense_system(const DampedStructure& damped) {
  const GlobalMesh& mesh = damped.mesh;
  DenseSystem dense;
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    for (int c = 0; c < 3; ++c) {
      if ((mesh.free_components[static_cast<std::size_t>(node)] >> c & 1) != 0) {
        dense.dof.insert({{node, c}, dense.dof.size()});
      }
    }
  }
  const std::size_t n = dense.dof.size();
  dense.mass.assign(n, 0.0);
  dense.stiffness.assign(n * n, 0.0);
  dense.damping.assign(n * n, 0.0);
  for (const ElementSet& set : mesh.regions) {
    const Region& region = damped.structure.regions[static_cast<std::size_t>(set.region)];
    const Rayleigh rayleigh = region.damping ? *region.damping : damped.structure.damping;
    const std::size_t size = 3 * static_cast<std::size_t>(element_layout(set.type).nodes);
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      std::vector<double> k(size * size), m(size);
      const auto [x, dofs] = placed_element(mesh, set, e, dense);
      element_matrices(set.type, x, element_properties(region), k, m);
      for (std::size_t i = 0; i < size; ++i) {
        if (dofs[i] == n) continue;
        dense.mass[dofs[i]] += m[i];
        dense.damping[dofs[i] * n + dofs[i]] += rayleigh.alpha * m[i];
        for (std::size_t j = 0; j < size; ++j) {
          if (dofs[j] == n) continue;
          dense.stiffness[dofs[i] * n + dofs[j]] += k[i * size + j];
          dense.damping[dofs[i] * n + dofs[j]] += rayleigh.beta * k[i * size + j];
        }
      }
    }
  }
  return dense;
}

/// Largest eigenvalue of M^-1 (2 dt C + dt^2 K).
inline double largest_growth(const DenseSystem& dense, double dt) {
  const std::size_t n = dense.mass.size();
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      matrix[i * n + j] =
          (2 * dt * dense.damping[i * n + j] + dt * dt * dense.stiffness[i * n + j]) /
          std::sqrt(dense.mass[i] * dense.mass[j]);
    }
  }
  return testing_support::symmetric_eigenvalues(std::move(matrix), n).back();
}

/// The time step at which 4 M - 2 dt C - dt^2 K stops being positive definite, by bisection.
inline double dense_stability_limit(const DenseSystem& dense) {
  double low = 1e-12;
  double high = 1e3;
  for (int i = 0; i < 120 && high > low * (1 + 1e-14); ++i) {
    const double middle = std::sqrt(low * high);
    (largest_growth(dense, middle) < 4 ? low : high) = middle;
  }
  return low;
}

}  // namespace pounding::testing_support
