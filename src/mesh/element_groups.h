#pragma once

#include <vector>

#include "mesh/element_graph.h"

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

}  // namespace pounding
