#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/element_graph.h"
#include "mesh/global_mesh.h"

/// Elements that are best not parted from each other. Serial.
namespace pounding {

/// Group of each entry of a list, -1: it is alone.
struct ElementGroups {
  std::vector<int> of;
  int count = 0;
  int first_cluster = 0;  ///< groups from here on are clusters
};

/// Bricks or shells in a row along which the nodes of a rank follow each other: their product is
/// done in one run. Rows are parted into equal pieces of at most `most_cost`.
ElementGroups group_rows(std::span<const GlobalMesh> meshes, const ElementList& list,
                         idx_t most_cost);

/// Adds the small elements inside each cluster.
void group_clusters(const ElementList& list, std::span<const NodeCluster> clusters,
                    ElementGroups& groups);

/// The list with one entry per group, behind all others.
ElementList merge_groups(const ElementList& all, const ElementGroups& groups);

/// Order in which the nodes of a structure follow each other on a rank: in layers across the
/// longest extent, and in each layer in rows along the second longest. Neighbours in space are
/// neighbours in memory, rows of elements have their nodes side by side, and few rows are cut where
/// a long structure is. Serial.
class NodePlanes {
 public:
  explicit NodePlanes(const GlobalMesh& mesh);

  /// Place of a point: its layer, its row in the layer, its place in the row, as numbers of planes
  /// that are so close together that nodes of one plane have one number in spite of round-off.
  std::array<std::int64_t, 3> place(const Vector3& x) const;

 private:
  std::array<std::size_t, 3> axes_{0, 1, 2};
  Vector3 low_{};
  double spacing_ = 0;  ///< [m]
};

}  // namespace pounding
