#include "dynamics/state.h"

#include <gtest/gtest.h>

#include "support/built_system.h"
#include "support/dense_damping.h"

namespace pounding {
namespace {

/// A beam along z, clamped at its foot: six components per node.
TEST(State, StartsWithOneDisplacementAndVelocityOfAllTranslations) {
  testing::DampedStructure mast;
  mast.structure.name = "mast";
  mast.structure.initial_displacement = {0.1, -0.2, 0.3};
  mast.structure.initial_velocity = {4, 5, 6};
  std::vector<GlobalIndex> line;
  for (GlobalIndex node = 0; node < 6; ++node) {
    mast.mesh.node_tags.push_back(node + 1);
    mast.mesh.coordinates.insert(mast.mesh.coordinates.end(), {0, 0, static_cast<double>(node)});
    mast.mesh.components.push_back(0x3f);
    if (node > 0) line.insert(line.end(), {node - 1, node});
  }
  mast.mesh.free_components = mast.mesh.components;
  mast.mesh.free_components[0] = 0;
  Region& stem = testing::add_region(mast, "stem", ElementType::beam, line);
  stem.material = {"steel", 2e11, 0.3, 7800};
  stem.section = Section{"tube", 1e-2, 1e-6, 1e-6, 1e-6, {1, 0, 0}};
  const testing::BuiltSystem built = testing::build_system(mast.mesh, mast.structure);
  const State state({&built.system, 1});
  ASSERT_EQ(state.structures.size(), 1U);
  const StructureState& body = state.structures[0];
  for (LocalIndex node = 0; node < built.mesh.owned_nodes; ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = built.mesh.dof(node, c);
      if (dof < 0) continue;
      const auto i = static_cast<std::size_t>(c);
      EXPECT_EQ(body.displacement[static_cast<std::size_t>(dof)],
                c < 3 ? mast.structure.initial_displacement[i] : 0);
      EXPECT_EQ(body.velocity[static_cast<std::size_t>(dof)],
                c < 3 ? mast.structure.initial_velocity[i] : 0);
    }
  }
}

}  // namespace
}  // namespace pounding
