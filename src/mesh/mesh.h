#pragma once

#include <algorithm>
#include <vector>

#include <mpi.h>

#include "mesh/global_mesh.h"
#include "mesh/mesh_parcel.h"
#include "mesh/partition.h"

namespace pounding {

/// Nodes that move together. One rank owns them all.
struct RigidPart {
  std::string group;  ///< as in the option; several may come of one
  RigidKind kind = RigidKind::body;
  std::uint8_t components = 0;  ///< that follow one rigid motion, one bit each
  GlobalIndex global_nodes = 0;
  std::vector<LocalIndex> nodes;  ///< increasing; none on the ranks that do not own them
  std::vector<TiedNode> tied;     ///< of ties, on the rank that owns the nodes
};

/// One structure's mesh and dofs on this rank.
///
///   nodes:  [ owned 0 .. owned_nodes ) [ ghost .. node_count )     ghosts: of shared elements
///   dofs:   [ owned 0 .. owned_dofs  ) [ ghost .. dof_count  )     node by node, free components
///   only
///
/// Owned dofs have consecutive global numbers from `first_owned_dof` (PETSc's numbering).
struct Mesh {
  MPI_Comm comm = MPI_COMM_SELF;
  std::string structure;
  GlobalIndex global_nodes = 0;
  GlobalIndex global_dofs = 0;            ///< free dofs over all ranks
  GlobalIndex global_dofs_unclamped = 0;  ///< the same before clamping
  LocalIndex owned_nodes = 0;
  LocalIndex owned_dofs = 0;
  GlobalIndex first_owned_dof = 0;
  std::vector<GlobalIndex> file_node;         ///< per local node: number in the file order
  std::vector<double> coordinates;            ///< shape (node_count, 3) [m]
  std::vector<std::uint8_t> free_components;  ///< per local node
  std::vector<GlobalIndex> ghost_dof;         ///< per ghost node: global number of its first dof
  std::vector<LocalIndex> first_dof;          ///< per local node: local number of its first dof
  LocalIndex dof_count = 0;                   ///< owned and ghost
  std::vector<ElementBlock> blocks;
  std::vector<RigidPart> rigid;          ///< in one order on all ranks
  std::vector<int> rigid_of;             ///< per local node into `rigid`, -1: in none
  std::vector<std::uint8_t> rigid_rows;  ///< likewise, components in which it follows, a bit each
  std::vector<LocalIndex> by_file_node;  ///< owned nodes in file order
  std::vector<AbsorbingNode> absorbing;  ///< at owned nodes, in file order
  std::vector<SupportedNode> supported;  ///< of the local nodes, in file order
  /// The support with which all the ground of the structure moves; -1: there is none.
  int ground_support = -1;
  std::vector<WaterBody> water;  ///< all of it; one rank owns the nodes that it moves

  LocalIndex node_count() const { return static_cast<LocalIndex>(file_node.size()); }
  /// Whether a component of a local node follows the rigid part that it is in.
  bool follows(LocalIndex node, int component) const {
    return (rigid_rows[static_cast<std::size_t>(node)] >> component & 1) != 0;
  }
  /// Local dof of a component (0-5) at a local node, -1 if it is clamped or does not exist.
  LocalIndex dof(LocalIndex node, int component) const {
    const std::uint8_t mask = free_components[node];
    if ((mask >> component & 1) == 0) return -1;
    const auto below = static_cast<std::uint8_t>(mask & ((1u << component) - 1u));
    return first_dof[node] + component_count(below);
  }
  /// Global number of the same dof.
  GlobalIndex dof_global(LocalIndex node, int component) const {
    const LocalIndex local = dof(node, component);
    if (local < 0) return -1;
    if (node < owned_nodes) return first_owned_dof + local;
    return ghost_dof[node - owned_nodes] + (local - first_dof[node]);
  }
  /// The support under a local node, null if there is none or the common ground.
  const SupportedNode* support_at(LocalIndex node) const {
    const auto found =
        std::ranges::lower_bound(supported, file_node[node], {}, &SupportedNode::node);
    return found != supported.end() && found->node == file_node[node] ? &*found : nullptr;
  }
  Vector3 position(LocalIndex node) const {
    const double* x = &coordinates[3 * node];
    return {x[0], x[1], x[2]};
  }
  /// Owned node with this number in the file order, or -1.
  LocalIndex owned_node(GlobalIndex file_number) const {
    const auto number = [this](LocalIndex node) { return file_node[node]; };
    const auto found = std::lower_bound(
        by_file_node.begin(), by_file_node.end(), file_number,
        [&](LocalIndex node, GlobalIndex wanted) { return number(node) < wanted; });
    return found != by_file_node.end() && number(*found) == file_number ? *found : -1;
  }
  /// Owned dof of a component at the node with this number in the file order, or -1.
  LocalIndex owned_dof(GlobalIndex file_number, int component) const {
    const LocalIndex node = owned_node(file_number);
    return node < 0 ? -1 : dof(node, component);
  }
};

/// Whether an element has a node of a rigid body.
bool meets_rigid_body(const Mesh& mesh, const ElementBlock& block, std::size_t element);

/// Whether a rigid body holds an element altogether, so that it never strains.
bool is_in_rigid_body(const Mesh& mesh, const ElementBlock& block, std::size_t element);

/// One rank's part of a structure out of its parcel. `marks` are read on rank 0 only. Collective.
Mesh join_parcel(MPI_Comm comm, const std::string& name, MeshParcel&& parcel,
                 const NodeMarks& marks);

/// Sends each rank its part of a structure. `global` and `partition` are read on rank 0 only;
/// `structure` is the index into the partition. Collective.
Mesh distribute_mesh(MPI_Comm comm, const std::string& name, const GlobalMesh& global,
                     const Partition& partition, int structure);

/// Bounding box of every node of a distributed mesh, which has at least one. Collective.
BoundingBox bounding_box(MPI_Comm comm, const Mesh& mesh);

/// Calls `visit(dof, node, component)` with each dof of the nodes [first, end), by their numbers.
void for_each_dof(const Mesh& mesh, LocalIndex first, LocalIndex end, const auto& visit) {
  for (LocalIndex node = first; node < end; ++node) {
    for (int c = 0; c < 6; ++c) {
      if (const LocalIndex dof = mesh.dof(node, c); dof >= 0) visit(dof, node, c);
    }
  }
}
void for_each_owned_dof(const Mesh& mesh, const auto& visit) {
  for_each_dof(mesh, 0, mesh.owned_nodes, visit);
}

/// Global numbers of the ghost dofs of a rank, in the order of their local numbers, as a Halo asks
/// for them.
inline std::vector<GlobalIndex> ghost_dofs(const Mesh& mesh) {
  std::vector<GlobalIndex> ghosts(mesh.dof_count - mesh.owned_dofs);
  for_each_dof(mesh, mesh.owned_nodes, mesh.node_count(),
               [&](LocalIndex dof, LocalIndex node, int c) {
                 ghosts[dof - mesh.owned_dofs] = mesh.dof_global(node, c);
               });
  return ghosts;
}

}  // namespace pounding
