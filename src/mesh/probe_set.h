#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/matrix3.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// A probe of the scene brought to nodes of a mesh.
struct ResolvedProbe {
  std::string name;
  int structure = 0;
  std::vector<GlobalIndex> nodes;  ///< file order; their mean is recorded
  int of = -1;                     ///< of a rotation, number of its probe
  int component = 0;               ///< first of three: 0 of displacements, 3 of rotations
  std::vector<Matrix3> weights;    ///< per node, by which its three count; empty: as they are
  Vector3 position{0, 0, 0};       ///< mean of the nodes [m]
  double snap_distance = 0;        ///< largest from a point asked for to its node, rank 0 [m]
  double element_size = 0;  ///< largest distance between nodes of an element there, rank 0 [m]
  const Vector3& weight(std::size_t node, std::size_t d) const {
    static constexpr Matrix3 whole{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    return weights.empty() ? whole[d] : weights[node][d];
  }

  static void members(auto& self, auto& stream) {
    stream(self.name, self.structure, self.nodes, self.of, self.component, self.weights,
           self.position, self.snap_distance, self.element_size);
  }
};

/// Snaps points to their nearest nodes and looks groups up; a probe that is not averaged becomes
/// one per node, "name.1", "name.2", ... Serial, rank 0. Throws UserError (unknown group, a point
/// farther from its node than 5 % of the extent of the mesh, or than the largest element there).
std::vector<ResolvedProbe> resolve_probes(const Scene& scene, std::span<const GlobalMesh> meshes);

/// Probes, and behind them the rotations "span.probe" at both ends of each span: of a node its own;
/// of one without, and of several nodes, that of the rigid body nearest to the displacements, in
/// least squares, of all nodes of its elements, or of the several; where these lie on a line the
/// mean of their own. Serial, rank 0. Throws UserError: no such probe with one record, both on one
/// structure, no rotation.
std::vector<ResolvedProbe> with_rotations(const Scene& scene, std::span<const GlobalMesh> meshes,
                                          std::vector<ResolvedProbe> probes);

/// Doubt about a node that is far from the point asked for, or "". `owner`: that has it.
std::string snap_doubt(const std::string& owner, double distance, double element_size);

/// Forms the groups of a structure that are given by points, and their elements; nodes are found
/// as those of probes are, and nodes far from their points doubted. `mesh`: has its own groups and
/// elements. Serial. Throws UserError likewise, and on a name that the mesh has, on two points of
/// one node.
void add_point_groups(const Structure& structure, GlobalMesh& mesh);

}  // namespace pounding
