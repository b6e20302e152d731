#pragma once

#include <cstdint>
#include <vector>

#include "common/types.h"

namespace pounding {

/// Value at a component of a node: of a load a force or moment at a history of 1 [N, N m], of a
/// start a displacement or rotation [m, rad] or its rate [m/s, rad/s].
struct NodalValue {
  GlobalIndex node = 0;        ///< file order
  std::int32_t component = 0;  ///< 0-2 along, 3-5 about x, y, z
  double value = 0;
};

/// A load of the scene as forces on the nodes of its structure, held components included.
struct NodalLoad {
  int structure = 0;               ///< in the scene
  std::vector<NodalValue> forces;  ///< by node and component, each once
  GlobalIndex nodes = 0;           ///< on which it acts
  double extent = 0;               ///< of its lines, surfaces or volumes [m, m2, m3]
  Vector3 force{0, 0, 0};          ///< sum of the forces [N]
  Vector3 moment{0, 0, 0};         ///< sum of the moments, and of the forces about the origin [N m]

  static void members(auto& self, auto& stream) {
    stream(self.structure, self.forces, self.nodes, self.extent, self.force, self.moment);
  }
};

/// Displacements and velocities at t = 0 of nodes of one structure that differ from those of all
/// its nodes, by node and component, each once.
struct NodalStart {
  std::vector<NodalValue> displacement;
  std::vector<NodalValue> velocity;

  bool empty() const { return displacement.empty() && velocity.empty(); }

  static void members(auto& self, auto& stream) { stream(self.displacement, self.velocity); }
};

}  // namespace pounding
