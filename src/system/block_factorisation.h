#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "common/types.h"

namespace pounding {

/// Owned dofs of one node, at most six, that follow each other.
struct NodeDofs {
  LocalIndex begin = 0;
  int count = 0;
};

/// Six by six numbers of a pair of nodes, row by row; 0 where a node has no dof.
using NodeBlock = std::array<double, 36>;

/// A symmetric matrix over the dofs of a few nodes of this rank, by blocks of two nodes.
struct NodeBlocks {
  std::vector<NodeDofs> nodes;                     ///< by their dofs
  std::map<std::array<int, 2>, NodeBlock> blocks;  ///< (row, column) into nodes, row >= column
};

/// An order in which to eliminate the vertices of a graph, and the graph of the factor.
struct Elimination {
  std::vector<int> order;                 ///< vertex by vertex
  std::vector<std::vector<int>> columns;  ///< per vertex: those left that it is connected with then
};

/// Rounds of vertices of the smallest degree that are no neighbours of each other (multiple minimum
/// degree). `neighbours` of each vertex, symmetric, without itself. Nothing where the columns would
/// hold more than `most` entries.
std::optional<Elimination> eliminate(std::vector<std::set<int>> neighbours, std::size_t most);

/// Sparse block factorisation of M + S, M diagonal and S symmetric positive semidefinite,
///
///     M + S = L D L^T
///
/// over nodes, L unit lower triangular and D block diagonal. Nodes are eliminated in rounds of
/// nodes that are no neighbours, fewest neighbours first, so that a ring of beams fills in little
/// and the processor can work at many nodes of a round at once.
///
/// Fields have shape (nodes, 6), nodes in the order of elimination; places that are no dofs hold 0.
/// Local; solutions allocate nothing and are the same bits on every run.
class BlockFactorisation {
 public:
  static constexpr std::size_t width = 6;  // values per node in a field

  /// `lumped_mass` of all owned dofs [kg, kg m2]; `added`: S. Throws std::runtime_error if M + S is
  /// not positive definite.
  BlockFactorisation(std::span<const double> lumped_mass, const NodeBlocks& added);

  /// Number of a node of S in a field.
  std::size_t order(std::size_t node) const { return order_[node]; }
  /// x = (M + S)^-1 x.
  void solve(double* x) const;
  /// x = G^-1 x and x = G^-T x with (M + S)^-1 = G^-T G^-1.
  void solve_half(double* x) const;
  void solve_transposed_half(double* x) const;

 private:
  void forward(double* x) const;
  void backward(double* x) const;

  std::vector<std::size_t> order_;  ///< per node of S: when it is eliminated
  /// Blocks of L row by row, and of L^T row by row, in the order in which they are read; each block
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
