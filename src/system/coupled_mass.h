#pragma once

#include <span>
#include <vector>

#include "system/added_mass.h"
#include "system/block_factorisation.h"
#include "system/rigid_body.h"

namespace pounding {

/// The mass M + S of those dofs of this rank that S couples, M diagonal and S symmetric positive
/// semidefinite, as a sparse factorisation (BlockFactorisation). Rigid bodies and tied parts couple
/// the mass of their nodes too: there (M + S)^-1 is W W^T and B (B^T M B)^-1 B^T. So does water the
/// mass of the nodes that it wets (AddedMass).
///
/// A field over the coupled dofs has shape (nodes, 6), nodes in the order of elimination, then
/// those of the rigid bodies one after the other, then those of the tied parts and of the waters;
/// places that are no dofs hold 0. Local; products and solutions allocate nothing and are the same
/// bits on every run.
class CoupledMass {
 public:
  static constexpr std::size_t width = 6;  // values per node in a field

  /// `lumped_mass` of all owned dofs [kg, kg m2]; `added`: S. Throws std::runtime_error if M + S is
  /// not positive definite. No node is in two of S, the rigid bodies, tied parts and waters.
  CoupledMass(std::span<const double> lumped_mass, NodeBlocks added,
              std::vector<RigidBody> bodies = {}, std::vector<TiedPart> ties = {},
              std::vector<AddedMass> waters = {});

  /// Nodes in the order of their dofs, and where in a field each of them is.
  const std::vector<NodeDofs>& nodes() const { return nodes_; }
  std::size_t offset(std::size_t node) const { return number_[node] * width; }
  std::size_t field_size() const { return width * nodes_.size(); }
  /// Which node holds an owned dof; -1: the dof is not coupled.
  int node_of(LocalIndex dof) const;
  const NodeBlocks& added() const { return added_; }  ///< with nodes of its own
  const std::vector<RigidBody>& bodies() const { return bodies_; }
  const std::vector<TiedPart>& ties() const { return ties_; }
  const std::vector<AddedMass>& waters() const { return waters_; }

  /// Rigid body that holds a node, or tied part, numbered after the bodies, or water, after those;
  /// -1: it is one of S.
  int part_of(std::size_t node) const;

  /// x = (M + S)^-1 x.
  void solve(double* x) const;
  /// Parts that nothing couples with the others: all of S, and those of part_of.
  struct Parts {
    bool added = false;
    std::vector<std::size_t> others;
  };
  /// x = (M + S)^-1 x in some parts of it.
  void solve(double* x, const Parts& parts) const;
  /// x = G^-1 x and x = G^-T x with (M + S)^-1 = G^-T G^-1.
  void solve_half(double* x) const;
  void solve_transposed_half(double* x) const;
  /// A field out of a vector over the owned dofs, and back into it.
  void take(const double* owned, double* x) const;
  void put(const double* x, double* owned) const;
  /// v^T S v of a vector over the owned dofs, with the added mass of the waters in S.
  double added_product(const double* v) const;

 private:
  void number_nodes();
  /// Calls `function(part, its part of the field)` for bodies, tied parts and waters.
  template <typename Function>
  void for_each_part(double* x, Function&& function) const;

  NodeBlocks added_;
  BlockFactorisation factor_;
  std::vector<RigidBody> bodies_;
  std::vector<TiedPart> ties_;
  std::vector<AddedMass> waters_;
  std::vector<std::size_t> first_node_;  ///< per body, tied part and water, in a field
  std::vector<NodeDofs> nodes_;          ///< of all
  std::vector<std::size_t> number_;      ///< per node: its number in a field
};

}  // namespace pounding
