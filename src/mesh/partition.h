#pragma once

#include <span>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Owner of every element and node, all structures together.
struct Partition {
  int parts = 1;
  std::vector<std::vector<int>> element_owner;  ///< per structure, elements in region order
  std::vector<std::vector<int>> node_owner;     ///< per structure
  long edge_cut = 0;                            ///< weight of the cut edges of the dual graph
  double imbalance = 1;                         ///< largest over mean element cost of a part
};

/// Partitions the elements of all structures with METIS on their dual graph (edges: shared nodes
/// beyond a corner; vertex weight: cost of the element; heavy edges for linked nodes)
/// with a fixed seed; or gives every structure to one part, where that is asked for or, with
/// `automatic`, costs a step less than the waiting of ranks that share a structure. A node belongs
/// to the part of most of its elements (element_graph.h); the nodes of a cluster, which shares
/// no node with another, to the part of most of them. `whole`: per structure the part that gets all
/// of it, -1 where it is to be cut; empty if all are. Serial.
Partition partition_meshes(std::span<const GlobalMesh> meshes, std::span<const NodeLink> links,
                           int parts, std::span<const int> whole = {},
                           std::span<const NodeCluster> clusters = {},
                           PartitionBy by = PartitionBy::elements);

}  // namespace pounding
