#include "interactions/contact_operator.h"

#include <algorithm>

#include "common/parallel.h"

namespace pounding::interactions {

namespace {

/// Whether a dof moves, and this rank owns it.
bool moves_here(const InterfaceDof& dof, std::span<const Mesh> meshes) {
  if (owned_dof(dof, meshes) >= 0) return true;
  const Mesh& mesh = meshes[dof.structure];
  const LocalIndex node = mesh.owned_node(dof.node);
  if (node < 0) return false;
  const SupportedNode* const at = mesh.support_at(node);
  return at != nullptr && at->holds(dof.component);
}

}  // namespace

LocalIndex owned_dof(const InterfaceDof& dof, std::span<const Mesh> meshes) {
  const Mesh& mesh = meshes[dof.structure];
  const LocalIndex node = mesh.owned_node(dof.node);
  return node < 0 ? -1 : mesh.dof(node, dof.component);
}

ContactOperator::ContactOperator(MPI_Comm comm, const std::vector<Constraint>& constraints,
                                 std::span<const Mesh> meshes,
                                 std::span<const ConstraintTerm> more) {
  Numbers number;
  std::vector<InterfaceDof> all;
  const auto add = [&](const ConstraintTerm& term) {
    const bool fresh =
        number
            .try_emplace({term.structure, term.node, term.component}, static_cast<int>(all.size()))
            .second;
    if (fresh) all.push_back({term.structure, term.node, term.component});
  };
  for (const Constraint& constraint : constraints) std::ranges::for_each(constraint.terms, add);
  std::ranges::for_each(more, add);
  std::vector<int> moves(all.size(), 0);
  std::transform(all.begin(), all.end(), moves.begin(),
                 [&](const InterfaceDof& dof) { return moves_here(dof, meshes) ? 1 : 0; });
  reduce_over_ranks(comm, MPI_MAX, moves);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (moves[i] == 0) continue;
    column_[{all[i].structure, all[i].node, all[i].component}] = static_cast<int>(dofs_.size());
    dofs_.push_back(all[i]);
  }
  set_rows(constraints);
}

void ContactOperator::set_rows(std::span<const Constraint> constraints) {
  rows_.clear();
  for (const Constraint& constraint : constraints) {
    for (const ConstraintTerm& term : constraint.terms) {
      const int dof = column(term.structure, term.node, term.component);
      if (dof >= 0) rows_.add(dof, term.coefficient);
    }
    rows_.end_row();
  }
}

int ContactOperator::column(int structure, GlobalIndex node, int component) const {
  const auto found = column_.find({structure, node, component});
  return found == column_.end() ? -1 : found->second;
}

void ContactOperator::add_transposed(int row, double value, std::span<double> y) const {
  const auto columns = row_dofs(row);
  const auto values = row_coefficients(row);
  for (std::size_t k = 0; k < columns.size(); ++k) y[columns[k]] += values[k] * value;
}

}  // namespace pounding::interactions
