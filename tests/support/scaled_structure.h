#pragma once

#include <vector>

#include "mesh/element_properties.h"
#include "stability/stable_time_step.h"
#include "support/built_system.h"
#include "support/dense_damping.h"
#include "system/mass_scaling.h"

/// A small structure whose stiff elements have their mass scaled, and its dense mass.
namespace pounding::testing_support {

/// Bricks on springs with dashpots, and a chain of stiff bars along the lower edges of the body,
/// all of whose springs and bars, and most of whose bricks, have their mass scaled.
inline DampedStructure scaled_structure(unsigned seed) {
  DampedStructure damped = random_structure(seed);
  Region& ties = add_region(damped, "ties", ElementType::bar, {0, 1, 1, 2, 2, 3, 3, 7});
  ties.material = {"steel", 2e11, 0.3, 100};
  ties.area = 0.01;
  const BuiltSystem plain = build_system(damped.mesh, damped.structure);
  damped.structure.mass_scaling = 2 * stability_limit(plain.system, plain.mesh);
  return damped;
}

/// M + S over all dofs.
inline std::vector<double> dense_mass(const DampedStructure& damped, const DenseSystem& dense) {
  const std::size_t n = dense.mass.size();
  std::vector<double> mass(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    mass[i * n + i] = dense.mass[i];
  }
  for (const ElementSet& set : damped.mesh.regions) {
    const Region& region = damped.structure.regions[static_cast<std::size_t>(set.region)];
    const std::size_t size = 3 * static_cast<std::size_t>(element_layout(set.type).nodes);
    for (std::size_t e = 0; traits_of(set.type).scalable && e < set.tags.size(); ++e) {
      std::vector<double> k(size * size), m(size), added(size * size);
      const auto [x, dofs] = placed_element(damped.mesh, set, e, dense);
      element_matrices(set.type, x, element_properties(region), k, m);
      add_element_mass(damped.structure.mass_scaling, damped.structure.damping_of(region), k, m,
                       added, 1, holding_part(set.type));
      for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < size; ++j) {
          if (dofs[i] < n && dofs[j] < n) mass[dofs[i] * n + dofs[j]] += added[i * size + j];
        }
      }
    }
  }
  return mass;
}

}  // namespace pounding::testing_support
