#pragma once

#include <vector>

#include "support/built_system.h"
#include "support/dense_damping.h"

namespace pounding::testing_support {

/// A steel tube of five beams along z, clamped at its foot: six components per node.
struct Mast {
  Structure structure;
  BuiltSystem built;
};

/// With an initial displacement [m] and velocity [m/s] of all its nodes. Collective.
inline Mast build_mast(const Vector3& displacement, const Vector3& velocity) {
  DampedStructure mast;
  mast.structure.name = "mast";
  mast.structure.initial_displacement = displacement;
  mast.structure.initial_velocity = velocity;
  std::vector<GlobalIndex> line;
  for (GlobalIndex node = 0; node < 6; ++node) {
    mast.mesh.node_tags.push_back(node + 1);
    mast.mesh.coordinates.insert(mast.mesh.coordinates.end(), {0, 0, static_cast<double>(node)});
    mast.mesh.components.push_back(0x3f);
    if (node > 0) line.insert(line.end(), {node - 1, node});
  }
  mast.mesh.free_components = mast.mesh.components;
  mast.mesh.free_components[0] = 0;
  Region& stem = add_region(mast, "stem", ElementType::euler_beam, line);
  stem.material = {"steel", 2e11, 0.3, 7800};
  stem.section = Section{"tube", 1e-2, 1e-6, 1e-6, 1e-6, {1, 0, 0}};
  return {mast.structure, build_system(mast.mesh, mast.structure)};
}

}  // namespace pounding::testing_support
