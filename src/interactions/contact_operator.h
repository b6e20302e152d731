#pragma once

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "interactions/pairing/interface.h"
#include "mesh/mesh.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {

/// A dof of the interface, by numbers that do not depend on the partition.
struct InterfaceDof {
  int structure = 0;
  GlobalIndex node = 0;  ///< file order
  int component = 0;
};

/// The contact operator L over the interface's own list of dofs, the same on every rank: a row per
/// constraint, a column per dof in order of first appearance. Clamped dofs are in it where
/// their support moves on its own.
class ContactOperator {
 public:
  /// `meshes` in the order of the scene's structures; every rank knows which dofs are clamped by
  /// asking their owners. Collective over `comm`.
  /// Dofs of `more` get columns after those of the constraints.
  ContactOperator(MPI_Comm comm, const std::vector<Constraint>& constraints,
                  std::span<const Mesh> meshes, std::span<const ConstraintTerm> more = {});

  /// Other rows over the same dofs; not collective.
  void set_rows(std::span<const Constraint> constraints);

  int rows() const { return static_cast<int>(rows_.rows()); }
  int dofs() const { return static_cast<int>(dofs_.size()); }
  const std::vector<InterfaceDof>& dof_list() const { return dofs_; }

  /// Column of a displacement; -1: it is clamped, or in no row.
  int column(int structure, GlobalIndex node, int component) const;

  std::span<const int> row_dofs(int row) const {
    return rows_.columns(static_cast<std::size_t>(row));
  }
  std::span<const double> row_coefficients(int row) const {
    return rows_.values(static_cast<std::size_t>(row));
  }

  /// (L x)_row for x over the interface's dofs.
  double apply(int row, std::span<const double> x) const {
    return row_product(rows_, static_cast<std::size_t>(row), x);
  }
  /// y += value * (row of L)^T.
  void add_transposed(int row, double value, std::span<double> y) const;

 private:
  using Numbers = std::map<std::tuple<int, GlobalIndex, int>, int>;

  std::vector<InterfaceDof> dofs_;
  Numbers column_;  ///< per structure, node and component; clamped dofs are not in it
  SparseRows rows_;
};

/// Local dof of an interface dof on the rank that owns it, -1 elsewhere.
LocalIndex owned_dof(const InterfaceDof& dof, std::span<const Mesh> meshes);

}  // namespace pounding::interactions
