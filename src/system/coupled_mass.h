#pragma once

#include <span>
#include <vector>

#include "system/node_blocks.h"
#include "system/rigid_body.h"

namespace pounding {

/// The mass M + S of those dofs of this rank that S couples, M diagonal and S symmetric positive
/// semidefinite, as a sparse block factorisation
///
///     M + S = L D L^T
///
/// over nodes, L unit lower triangular and D block diagonal. Nodes are eliminated in rounds of
/// nodes that are no neighbours, fewest neighbours first, so that a ring of beams fills in little
/// and the processor can work at many nodes of a round at once.
///
/// Rigid bodies couple the mass of their nodes too: there W W^T stands for (M + S)^-1.
///
/// A field over the coupled dofs has shape (nodes, 6), nodes in the order of elimination, then
/// those of the rigid bodies one after the other; places that are no dofs hold 0. Local; products
/// and solutions allocate nothing and are the same bits on every run.
class CoupledMass {
 public:
  static constexpr std::size_t width = 6;  // values per node in a field

  /// `lumped_mass` of all owned dofs [kg, kg m2]; `added`: S. Throws std::runtime_error if M + S is
  /// not positive definite. No node of a rigid body is one of S.
  CoupledMass(std::span<const double> lumped_mass, NodeBlocks added,
              std::vector<RigidBody> bodies = {});

  /// Nodes in the order of their dofs, and where in a field each of them is.
  const std::vector<NodeDofs>& nodes() const { return nodes_; }
  std::size_t place(std::size_t node) const { return place_[node] * width; }
  std::size_t field_size() const { return width * nodes_.size(); }
  /// Which node holds an owned dof; -1: the dof is not coupled.
  int node_of(LocalIndex dof) const;
  const NodeBlocks& added() const { return added_; }  ///< with nodes of its own
  const std::vector<RigidBody>& bodies() const { return bodies_; }

  /// Rigid body that holds a node; -1: it is one of S.
  int body_of(std::size_t node) const;

  /// x = (M + S)^-1 x.
  void solve(double* x) const;
  /// Parts that nothing couples with the others: all of S, and bodies by their numbers.
  struct Parts {
    bool added = false;
    std::vector<std::size_t> bodies;
  };
  /// x = (M + S)^-1 x in some parts of it.
  void solve(double* x, const Parts& parts) const;
  /// x = G^-1 x and x = G^-T x with (M + S)^-1 = G^-T G^-1.
  void solve_half(double* x) const;
  void solve_transposed_half(double* x) const;
  /// A field out of a vector over the owned dofs, and back into it.
  void take(const double* owned, double* x) const;
  void put(const double* x, double* owned) const;
  /// v^T S v of a vector over the owned dofs.
  double added_product(const double* v) const;

 private:
  void factorise(std::span<const double> lumped_mass);
  void forward(double* x) const;
  void backward(double* x) const;

  void place_nodes();
  void solve_added(double* x) const;
  /// Calls `function(body, its part of the field)`.
  template <typename Function>
  void for_each_body(double* x, Function&& function) const;

  NodeBlocks added_;
  std::vector<RigidBody> bodies_;
  std::vector<std::size_t> first_node_;  ///< per body, in a field
  std::vector<NodeDofs> nodes_;          ///< of both
  std::vector<std::size_t> order_;       ///< per node of S: when it is eliminated
  std::vector<std::size_t> place_;       ///< per node: its number in a field
  /// Blocks of L row by row, and of L^T likewise, in the order in which they are read; each block
  /// column by column.
  std::vector<std::size_t> lower_begin_;
  std::vector<std::size_t> lower_column_;
  std::vector<NodeBlock> lower_;
  std::vector<std::size_t> upper_begin_;
  std::vector<std::size_t> upper_column_;
  std::vector<NodeBlock> upper_;
  std::vector<NodeBlock> inverse_diagonal_;  ///< D^-1
  std::vector<NodeBlock> inverse_root_;      ///< R^-1 column by column, D = R R^T
  std::vector<NodeBlock> inverse_root_transposed_;
};

}  // namespace pounding
