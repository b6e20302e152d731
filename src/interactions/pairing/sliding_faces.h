#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/matrix3.h"
#include "mesh/global_mesh.h"

namespace pounding::interactions {

/// The parts of the faces of a scene along which pairs are found anew as they slide, as the meshes
/// are: rows of the interface, the facets that each may come to face and the nodes of both.
struct SlidingFaces {
  struct Node {
    int structure = 0;
    GlobalIndex node = 0;  ///< file order
    Vector3 position{};    ///< [m]
  };
  struct Facet {
    int count = 0;               ///< 3 or 4 nodes
    std::array<int, 4> nodes{};  ///< into `nodes`
    double half_thickness = 0;   ///< of a shell [m]
    double size = 0;             ///< side of a square of its area [m]
  };
  struct Row {
    int constraint = 0;
    int contact = 0;            ///< index into the scene's contacts
    int node = 0;               ///< secondary, into `nodes`
    Vector3 normal{};           ///< outward there, unit
    double half_thickness = 0;  ///< of a shell there [m]
    double depth = 0;           ///< how far behind it a facet may lie [m]
    double offset = 0;          ///< the gap given less that of the meshes [m]
    int first = 0;              ///< of the facets that it may face, into `candidates`
    int end = 0;
  };
  std::vector<Node> nodes;
  std::vector<Facet> facets;
  std::vector<Row> rows;
  std::vector<int> candidates;

  bool empty() const { return rows.empty(); }
};

}  // namespace pounding::interactions
