#pragma once

#include <span>
#include <vector>

#include <metis.h>

#include "mesh/global_mesh.h"

/// The elements of a scene as a graph for METIS. Serial.
namespace pounding {

/// Every element of every structure in one list, with global node numbers that run on from
/// structure to structure. The elements of a group, which METIS must not cut, are one entry.
struct ElementList {
  std::vector<idx_t> first;  ///< CSR offsets into nodes
  std::vector<GlobalIndex> nodes;
  std::vector<idx_t> cost;
  std::vector<int> structure;
  std::vector<int> needed;  ///< shared nodes that make two elements neighbours
  std::vector<GlobalIndex> node_offset;
  std::vector<std::size_t> element_offset;
  std::vector<idx_t> entry;  ///< of each element
  GlobalIndex node_count = 0;

  idx_t count() const { return static_cast<idx_t>(cost.size()); }
  std::span<const GlobalIndex> nodes_of(std::size_t e) const {
    return {nodes.data() + first[e], nodes.data() + first[e + 1]};
  }
};

/// The elements of the structures that are cut; `whole` as in `partition_meshes`.
ElementList list_elements(std::span<const GlobalMesh> meshes, std::span<const int> whole);

/// Elements at each node, CSR.
struct NodeElements {
  std::vector<std::size_t> first;
  std::vector<idx_t> elements;
};

NodeElements elements_at_nodes(const ElementList& list);

/// CSR, edges weighted by shared nodes and linked faces.
struct Graph {
  std::vector<idx_t> first{0};
  std::vector<idx_t> neighbours;
  std::vector<idx_t> weights;
};

Graph dual_graph(const ElementList& list, const NodeElements& at, std::span<const NodeLink> links,
                 std::span<const int> whole);

/// Cuts a graph into parts of alike cost with few edges between them, by METIS: the part of each
/// vertex, its number where there are no more vertices than parts. `edge_cut`: weight of the edges
/// that are cut. The same bits every time. Throws std::runtime_error.
std::vector<idx_t> cut_graph(Graph& graph, std::vector<idx_t>& cost, int parts, long& edge_cut);

/// Part that gets all of a structure; -1: it is cut.
int whole_part(std::span<const int> whole, std::size_t structure);

/// Owner of every node of all structures: the part of most of its elements. Where two parts have as
/// many of them, as along a straight cut, all such nodes of the two go to one part, which then
/// holds the elements on both sides of the cut: the longest cuts first, each to the part that holds
/// less by then. `owner`, `cost`: of the elements. Serial.
std::vector<int> node_owners(const NodeElements& at, std::span<const idx_t> owner,
                             std::span<const idx_t> cost, int parts);

}  // namespace pounding
