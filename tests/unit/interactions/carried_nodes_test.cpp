#include <gtest/gtest.h>

#include "interactions/pairing/contact_face.h"

namespace pounding::interactions {
namespace carried_nodes_test {

using Flags = std::vector<char>;

Carrier carrier(GlobalIndex node, double share, double turning = 0) {
  Carrier made{node, {}};
  for (const std::size_t k : {0, 7, 14}) made.block[k] = share;
  made.block[2] = turning;
  return made;
}

/// Nodes 0 to 3 are followed by 4, between 0 and 1, and by 5, between 2 and 3.
struct Scene {
  GlobalMesh mesh;
  ContactFace face;
  Scene() {
    mesh.free_components.assign(6, 0x07);
    RigidNodes part;
    part.kind = RigidKind::tie;
    part.tied.push_back({4, 0, {carrier(0, 0.25), carrier(1, 0.75), carrier(2, 0, 0.1)}});
    part.tied.push_back({5, 0, {carrier(2, 1.5), carrier(3, -0.5)}});
    mesh.rigid.push_back(part);
  }
  Flags carried(std::vector<GlobalIndex> nodes, const Flags& has_row) {
    face.nodes = std::move(nodes);
    return carried_nodes(mesh, face, has_row);
  }
};

TEST(CarriedNodes, FollowNodesOfTheFaceAlone) {
  Scene scene;
  EXPECT_EQ(scene.carried({0, 1, 2, 3, 4, 5}, Flags(6, 1)), (Flags{0, 0, 0, 0, 1, 1}));
  // Node 2 only turns node 4, but node 3 displaces node 5.
  EXPECT_EQ(scene.carried({0, 1, 4, 5}, Flags(4, 1)), (Flags{0, 0, 1, 0}));
  EXPECT_EQ(scene.carried({0, 4}, Flags(2, 1)), (Flags{0, 0}));
  EXPECT_EQ(scene.carried({0, 1, 2}, Flags(3, 1)), (Flags{0, 0, 0}));
}

TEST(CarriedNodes, FollowNodesThatFaceSomething) {
  Scene scene;
  EXPECT_EQ(scene.carried({0, 1, 2, 3, 4, 5}, {1, 0, 1, 1, 1, 1}), (Flags{0, 0, 0, 0, 0, 1}));
  scene.mesh.free_components[1] = 0;  // held by a clamp
  EXPECT_EQ(scene.carried({0, 1, 2, 3, 4, 5}, {1, 0, 1, 1, 1, 1}), (Flags{0, 0, 0, 0, 1, 1}));
}

}  // namespace carried_nodes_test
}  // namespace pounding::interactions
