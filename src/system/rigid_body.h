#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "system/block_factorisation.h"

namespace pounding {

/// Rigid body: nodes of a structure whose dofs follow at most six motions R, as a mat or equipment
/// feet do, or three, as a level floor that is rigid in its plane. Its nodes move by
///
///     v = R (R^T M R)^-1 R^T M v* = W W^T M v*,      W^T M W = I
///
/// where v* is the velocity of the nodes alone: the projection that is orthogonal in M. It changes
/// no momentum, its forces of constraint do no work, and no frequency rises by it. W has a column
/// for every motion that the nodes see: fewer than six for solids whose nodes lie in a line.
///
/// Fields have six places per node, in the order of the node's dofs; dofs that do not follow have
/// their own mass. One rank owns all of it. Products allocate nothing.
class RigidBody {
 public:
  static constexpr std::size_t width = 6;

  /// `part` of the mesh, owned by this rank; `lumped_mass` of all owned dofs [kg, kg m2].
  RigidBody(const Mesh& mesh, const RigidPart& part, std::span<const double> lumped_mass);

  const std::vector<NodeDofs>& nodes() const { return nodes_; }  ///< by their dofs
  std::size_t motions() const { return motions_; }               ///< columns of W
  /// Owned dofs that follow, by increasing number, and their rows of W [kg^-1/2].
  const std::vector<LocalIndex>& dofs() const { return dofs_; }
  std::span<const double, width> row(std::size_t k) const {
    return std::span<const double, width>(&rows_[slots_[k] / width][slots_[k] % width * width],
                                          width);
  }

  /// Forces to changes of velocity: x = W W^T x, and x = M^-1 x where nothing follows.
  void solve(double* x) const { move(coordinates(x), x); }
  /// x = M^1/2 W W^T x, and x = W W^T M^1/2 x, with M^-1/2 where nothing follows.
  void solve_half(double* x) const;
  void solve_transposed_half(double* x) const;

 private:
  using Motion = std::array<double, width>;

  void find_motions(const Mesh& mesh, const RigidPart& part);
  Motion coordinates(const double* x) const;    ///< W^T x
  void move(const Motion& q, double* x) const;  ///< x = W q, M^-1 x where nothing follows
  void scale(double* x) const;                  ///< x = M^1/2 x

  std::size_t motions_ = 0;
  std::vector<NodeDofs> nodes_;
  std::vector<LocalIndex> dofs_;
  std::vector<std::size_t> slots_;  ///< of dofs_ in a field
  std::vector<NodeBlock> rows_;     ///< of W, node by node; 0 where nothing follows
  std::vector<NodeBlock> columns_;  ///< of W, node by node, transposed
  std::vector<double> root_mass_;   ///< M^1/2 per place of a field; 0 where there is no dof
  std::vector<double> alone_;       ///< M^-1 where a dof does not follow, else 0
};

/// Rigid bodies of a structure that come of one group, or the nodes that follow by one tie, for the
/// report.
struct RigidBodyReport {
  std::string group;
  RigidKind kind = RigidKind::body;
  GlobalIndex bodies = 0;
  GlobalIndex nodes = 0;
  GlobalIndex dofs = 0;  ///< that follow
  /// Motions of the bodies: 3 or 6 of each, fewer where its nodes see fewer; 0 of a tie.
  GlobalIndex motions = 0;
  double mass = 0;  ///< of the nodes, along x [kg]
};

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
