#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "system/block_factorisation.h"
#include "system/node_blocks.h"

namespace pounding {

/// Nodes that follow facets, and their carriers: with u = B u_c of all of them, B the identity for
/// carriers, forces become changes of velocity by
///
///     v = B (B^T M B)^-1 B^T f
///
/// the projection, orthogonal in M, of the motion of the nodes alone. It changes neither momentum
/// nor angular momentum, since B holds every rigid motion; its forces of constraint do no work, and
/// no frequency rises by it. B^T M B is M of the carriers and B^T M B of the nodes that follow:
/// sparse, and factorised once.
///
/// Fields have six places per node, in the order of the node's dofs: the carriers, then those that
/// follow. One rank owns all of it. Products allocate nothing.
class TiedPart {
 public:
  static constexpr std::size_t width = BlockFactorisation::width;

  /// `part` of the mesh, a tie owned by this rank; `lumped_mass` of all owned dofs [kg, kg m2].
  TiedPart(const Mesh& mesh, const RigidPart& part, std::span<const double> lumped_mass);

  const std::vector<NodeDofs>& nodes() const { return nodes_; }  ///< in the order of fields
  std::size_t carriers() const { return carriers_; }             ///< the first of the nodes

  /// Forces to changes of velocity: x = B (B^T M B)^-1 B^T x.
  void solve(double* x) const;
  /// x = G^-1 B^T x, 0 for followers, and x = B G^-T x, with B^T M B = G G^T.
  void solve_half(double* x) const;
  void solve_transposed_half(double* x) const;
  /// x = B^T x, 0 for followers, and x = B x.
  void collect(double* x) const;
  void spread(double* x) const;

 private:
  /// Share of one carrier in one node.
  struct Term {
    std::size_t carrier = 0;  ///< its number in a field
    NodeBlock block{};        ///< of B, column by column
    NodeBlock transposed{};   ///< row by row
  };
  void find_nodes(const Mesh& mesh, const RigidPart& part);
  void add_terms(const Mesh& mesh, const TiedNode& tied);
  /// B^T M B of the nodes that follow, over the carriers by their dofs.
  NodeBlocks followers_mass(std::span<const double> lumped_mass) const;

  std::size_t carriers_ = 0;
  std::vector<NodeDofs> nodes_;
  std::vector<LocalIndex> local_;        ///< node of the mesh, carriers by their dofs
  std::vector<std::size_t> first_term_;  ///< per node that follows
  std::vector<Term> terms_;
  BlockFactorisation factor_;
};

}  // namespace pounding
