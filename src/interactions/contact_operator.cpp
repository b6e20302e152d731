#include "interactions/contact_operator.h"

#include <algorithm>

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
  MPI_Allreduce(MPI_IN_PLACE, moves.data(), static_cast<int>(moves.size()), MPI_INT, MPI_MAX, comm);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (moves[i] == 0) continue;
    column_[{all[i].structure, all[i].node, all[i].component}] = static_cast<int>(dofs_.size());
    dofs_.push_back(all[i]);
  }
  set_rows(constraints);
}

void ContactOperator::set_rows(std::span<const Constraint> constraints) {
  row_begin_.assign(1, 0);
  row_dof_.clear();
  row_coefficient_.clear();
  for (const Constraint& constraint : constraints) {
    for (const ConstraintTerm& term : constraint.terms) {
      const auto found = column_.find({term.structure, term.node, term.component});
      if (found == column_.end()) continue;
      row_dof_.push_back(found->second);
      row_coefficient_.push_back(term.coefficient);
    }
    row_begin_.push_back(row_dof_.size());
  }
}

double ContactOperator::apply(int row, std::span<const double> x) const {
  const auto columns = row_dofs(row);
  const auto values = row_coefficients(row);
  double sum = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) sum += values[k] * x[columns[k]];
  return sum;
}

void ContactOperator::add_transposed(int row, double value, std::span<double> y) const {
  const auto columns = row_dofs(row);
  const auto values = row_coefficients(row);
  for (std::size_t k = 0; k < columns.size(); ++k) y[columns[k]] += values[k] * value;
}

}  // namespace pounding::interactions
