#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/types.h"
#include "elements/element_traits.h"
#include "elements/measured_costs.h"
#include "mesh/absorbing_node.h"
#include "mesh/supported_node.h"
#include "mesh/tied_node.h"
#include "scene/scene.h"

/// A whole mesh as rank 0 holds it between reading and distribution. Nodes are numbered from 0 in
/// the order of their tags ("file order"); only nodes that an element of the scene uses exist.
namespace pounding {

/// A facet of a physical group: 3 or 4 nodes of a surface, 2 of an edge.
struct Facet {
  std::array<GlobalIndex, 4> nodes{-1, -1, -1, -1};
  int count = 0;
  std::span<const GlobalIndex> corners() const {
    return {nodes.data(), static_cast<std::size_t>(count)};
  }
};

/// A physical group of the file: its nodes (sorted), and its surface or edge facets.
struct NodeGroup {
  std::vector<GlobalIndex> nodes;
  std::vector<Facet> facets;
};

/// The elements of one kind in a region of the scene (a shell region may hold two kinds).
struct ElementSet {
  std::string group;
  int region = 0;  ///< index into the structure's regions
  ElementType type = ElementType::hex8;
  std::vector<std::int64_t> tags;         ///< as in the file
  std::vector<GlobalIndex> connectivity;  ///< shape (n_elements, nodes of the type)
  /// Share of each element in the length [m] or area [m2] over which its region is spread; empty
  /// where it is not. Then elements are nodes, and have their tags.
  std::vector<double> share;
  bool inelastic = false;  ///< an element law adds to their forces
  double share_of(std::size_t element) const { return share.empty() ? 1 : share[element]; }
  /// Cost of a step of one of these elements, see measured_costs.h.
  int cost() const { return traits_of(type).cost + (inelastic ? measured_costs::inelastic : 0); }
};

/// Elements of a physical group, or of none (""), that are in no region of the scene.
struct UnusedElements {
  std::string group;
  std::string kind;       ///< "Line 2"
  GlobalIndex count = 0;  ///< of the group
  /// Elements of `count` that are not faces or edges of elements in use: left out of the structure.
  GlobalIndex left_out = 0;
  Vector3 place{0, 0, 0};  ///< of the first that is left out, or else of the first [m]
};

/// Nodes that move together.
struct RigidNodes {
  std::string group;  ///< as in the option; several may come of one
  RigidKind kind = RigidKind::body;
  std::uint8_t components = 0;     ///< that follow one rigid motion, one bit each
  std::vector<GlobalIndex> nodes;  ///< sorted; of ties the carriers as well
  std::vector<TiedNode> tied;      ///< of ties
};

/// Marks of nodes of a structure beside its elements; every rank learns them.
struct NodeMarks {
  std::vector<RigidNodes> rigid;  ///< no node is in two of them; ties are the last
  /// Nodes of absorbing faces; found after reading, with the elements behind these faces.
  std::vector<AbsorbingNode> absorbing;
  std::vector<SupportedNode> supported;  ///< sorted; empty where the ground moves as one
  /// The support with which all the ground moves, into the scene's supports; -1: there is none.
  int ground_support = -1;
};

/// Marks, to a byte stream or from it (common/byte_stream.h).
template <typename Stream, typename Marks>
void pass_marks(Stream& stream, Marks& marks) {
  stream.list(marks.rigid, [&](auto& part) {
    stream(part.group);
    stream(part.kind);
    stream(part.components);
    stream.array(part.nodes);
    stream.list(part.tied, [&](auto& tied) {
      stream(tied.node);
      stream(tied.group);
      stream.array(tied.carriers);
    });
  });
  stream.array(marks.absorbing);
  stream.array(marks.supported);
  stream(marks.ground_support);
}

struct GlobalMesh : NodeMarks {
  std::vector<double> coordinates;      ///< shape (n_nodes, 3) [m]
  std::vector<std::int64_t> node_tags;  ///< as in the file
  std::vector<ElementSet> regions;      ///< in the order of the structure's regions
  std::map<std::string, NodeGroup> groups;
  std::vector<std::string> doubts;     ///< of ties, one line each
  std::vector<UnusedElements> unused;  ///< points do not count
  /// One bit per free component of a node: 0-2 translations, 3-5 rotations. Rotations exist where
  /// an element asks for them; clamped components are not free.
  std::vector<std::uint8_t> free_components;
  /// Components of each node before clamping, a bit each.
  std::vector<std::uint8_t> components;

  GlobalIndex node_count() const { return static_cast<GlobalIndex>(node_tags.size()); }
  Vector3 position(GlobalIndex node) const {
    const double* x = &coordinates[3 * node];
    return {x[0], x[1], x[2]};
  }
};

/// Mean of the positions of some nodes.
Vector3 centroid(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes);

/// Number of dofs of a component mask.
constexpr int component_count(std::uint8_t mask) {
  return __builtin_popcount(mask);
}

}  // namespace pounding
