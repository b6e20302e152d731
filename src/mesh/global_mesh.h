#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/types.h"
#include "elements/element_traits.h"
#include "elements/measured_costs.h"
#include "scene/scene.h"

namespace pounding {

/// A node that a tied one follows, and how: entry 6 i + j is the part of component i of the tied
/// node (displacements, then rotations) by component j of the carrier [-, m, 1/m].
struct Carrier {
  GlobalIndex node = 0;  ///< file order
  std::array<double, 36> block{};
};

/// A node that follows a facet: u = sum of B_i u_i over its carriers, for its displacements and its
/// rotations. Rigid motions of the carriers are the same of the node.
struct TiedNode {
  GlobalIndex node = 0;  ///< file order
  int group = 0;         ///< index into the structure's rigid groups
  std::vector<Carrier> carriers;

  static void members(auto& self, auto& stream) { stream(self.node, self.group, self.carriers); }
};

/// A clamped node on a support that moves on its own.
struct SupportedNode {
  GlobalIndex node = 0;  ///< file order
  int support = 0;       ///< into the scene's supports
  int components = 0;    ///< that are clamped, one bit each: 0-2 translations, 3-5 rotations

  bool holds(int component) const { return (components >> component & 1) != 0; }
};

/// Node of absorbing faces: the endless continuation of the solids behind them resists its velocity
/// by C = sum over faces of A_i rho (V_p n n^T + V_s (I - n n^T)), with A_i the node's share of a
/// face's area, n its unit normal, rho, V_p, V_s of the element behind it (Lysmer and Kuhlemeyer,
/// J. Eng. Mech. Div. 95 (1969)). As dashpots, each along one axis,
///
///     C = sum_k c_k a_k a_k^T,      force of a wave from below = sum_k a_k (w_k . v_in)
///
/// with |a_k| = 1, the scaled columns of the Cholesky factor of C. Where the wave does not move all
/// nodes alike, v_in has the histories of its shapes behind the three components.
struct AbsorbingNode {
  GlobalIndex node = 0;            ///< file order
  std::array<Vector3, 3> axis{};   ///< a_k
  Vector3 dashpot{};               ///< c_k [N s/m]
  std::vector<double> incident{};  ///< w_k, one after the other [N s/m]; zero away from the base

  static void members(auto& self, auto& stream) {
    stream(self.node, self.axis, self.dashpot, self.incident);
  }
};

/// A whole mesh as rank 0 holds it between reading and distribution. Nodes are numbered from 0 in
/// the order of their tags ("file order"); only nodes that an element of the scene uses exist.

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
  /// Share of each element in the length [m] or area [m2] over which its region is spread, or in
  /// the masses and springs of a region of water [-]; empty where there is none. Elements that are
  /// nodes have the tags of these then.
  std::vector<double> share;
  bool inelastic = false;  ///< an element law adds to their forces
  /// Nodes of an element in the order of its type.
  std::span<const GlobalIndex> nodes_of(std::size_t element) const {
    const auto width = static_cast<std::size_t>(element_layout(type).nodes);
    return {&connectivity[element * width], width};
  }
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

  static void members(auto& self, auto& stream) {
    stream(self.group, self.kind, self.count, self.left_out, self.place);
  }
};

/// Nodes that move together.
struct RigidNodes {
  std::string group;  ///< as in the option; several may come of one
  RigidKind kind = RigidKind::body;
  std::uint8_t components = 0;     ///< that follow one rigid motion, one bit each
  std::vector<GlobalIndex> nodes;  ///< sorted; of ties the carriers as well
  std::vector<std::uint8_t> rows;  ///< components in which each node follows; empty: all of those
  std::vector<TiedNode> tied;      ///< of ties

  static void members(auto& self, auto& stream) {
    stream(self.group, self.kind, self.components, self.nodes, self.rows, self.tied);
  }
};

/// Water of any shape that wets nodes of a structure, p = 0 on its free surface: the Laplacian of
/// its pressures, row by row, and how these press. Pressures of wetted nodes are the first.
struct WaterBody {
  std::string pool;
  double density = 0;              ///< [kg/m3]
  std::vector<GlobalIndex> nodes;  ///< that are wetted, increasing, file order
  std::vector<Vector3> area;       ///< of these: of the water's faces there, out of it [m2]
  std::int32_t pressures = 0;
  std::vector<std::int64_t> row_begin;
  std::vector<std::int32_t> columns;
  std::vector<double> laplacian;  ///< [m]
  PoolOutline outline;

  static void members(auto& self, auto& stream) {
    stream(self.pool, self.density, self.nodes, self.area, self.pressures, self.row_begin,
           self.columns, self.laplacian, self.outline);
  }
};

/// Marks of nodes of a structure beside its elements; every rank learns them.
struct NodeMarks {
  std::vector<RigidNodes> rigid;  ///< no node is in two of them; ties are the last
  /// Nodes of absorbing faces; found after reading, with the elements behind these faces.
  std::vector<AbsorbingNode> absorbing;
  std::vector<SupportedNode> supported;  ///< sorted; empty where the ground moves as one
  /// The support with which all the ground moves, into the scene's supports; -1: there is none.
  int ground_support = -1;
  std::vector<WaterBody> water;  ///< of pools that have cells, in their order; no node is in two

  static void members(auto& self, auto& stream) {
    stream(self.rigid, self.absorbing, self.supported, self.ground_support, self.water);
  }
};

struct GlobalMesh : NodeMarks {
  std::vector<double> coordinates;      ///< shape (n_nodes, 3) [m]
  std::vector<std::int64_t> node_tags;  ///< as in the file
  std::vector<ElementSet> regions;      ///< in the order of the structure's regions
  std::map<std::string, NodeGroup> groups;
  std::vector<std::string> doubts;     ///< of ties, one line each
  std::vector<UnusedElements> unused;  ///< points do not count
  std::vector<PoolOutline> pools;      ///< of the structure, in their order
  /// One bit per free component of a node: 0-2 translations, 3-5 rotations. Rotations exist where
  /// an element asks for them; clamped components are not free.
  std::vector<std::uint8_t> free_components;
  /// Components of each node before clamping, a bit each.
  std::vector<std::uint8_t> components;

  /// Components that a node has and that are clamped, a bit each.
  std::uint8_t clamped(GlobalIndex node) const {
    return components[node] & static_cast<std::uint8_t>(~free_components[node]);
  }
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

/// Rotations about x, y, z in the bits of a node's components.
inline constexpr std::uint8_t rotation_bits = 0x38;

/// Names of groups, for a message: "base, face1, slab".
template <typename Group>
std::string group_names(const std::map<std::string, Group>& groups) {
  std::string names;
  for (const auto& [name, group] : groups) names += (names.empty() ? "" : ", ") + name;
  return names;
}
inline std::string group_names(const GlobalMesh& mesh) {
  return group_names(mesh.groups);
}

/// Two nodes, of any two structures, that should live on one rank: facing nodes of a contact.
struct NodeLink {
  int structure_a = 0;
  GlobalIndex node_a = 0;
  int structure_b = 0;
  GlobalIndex node_b = 0;
};

/// Nodes of one structure that one rank must own.
struct NodeCluster {
  int structure = 0;
  std::vector<GlobalIndex> nodes;
};

/// Between two points [m].
double distance(const Vector3& x, const Vector3& y);

/// Bounding box of a set of nodes, its sides along the axes.
struct BoundingBox {
  Vector3 low{1e300, 1e300, 1e300};      ///< [m]
  Vector3 high{-1e300, -1e300, -1e300};  ///< [m]

  void include(const Vector3& x);
  double diagonal() const { return distance(low, high); }
  /// [m]
  Vector3 sides() const { return {high[0] - low[0], high[1] - low[1], high[2] - low[2]}; }
  double longest_side() const;
};

/// Bounding box of some nodes.
BoundingBox bounding_box(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes);

/// Bounding box of every node of some meshes, which have at least one. Serial.
BoundingBox bounding_box(std::span<const GlobalMesh> meshes);

/// A group of springs that are spread over an area or along lines.
struct SpreadReport {
  std::int32_t region = 0;  ///< index into those of the structure
  std::int64_t nodes = 0;
  double extent = 0;  ///< [m2] or [m]
};

/// The groups of a structure whose springs are spread, in the order of its regions.
std::vector<SpreadReport> find_spread_springs(const GlobalMesh& mesh);

}  // namespace pounding
