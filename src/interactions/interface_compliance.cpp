#include "interactions/interface_compliance.h"

#include "common/disjoint_sets.h"
#include "common/parallel.h"

namespace pounding::interactions {
namespace {

/// The rows of G of the dofs that a rank knows and that do not move alone.
struct KnownRows {
  std::vector<int> dof;
  SparseRows rows;
};

KnownRows known_rows(std::span<const std::vector<int>> structure_dofs, std::span<Trace> traces,
                     std::span<double> diagonal) {
  KnownRows mine;
  for (std::size_t s = 0; s < traces.size(); ++s) {
    const std::vector<int>& known = traces[s].known();
    for (std::size_t a = 0; a < known.size(); ++a) {
      const int dof = structure_dofs[s][known[a]];
      diagonal[dof] = traces[s].compliance(a, a);
      if (!traces[s].moves_others(a)) continue;
      mine.dof.push_back(dof);
      for (std::size_t b = 0; b < known.size(); ++b) {
        const double value = traces[s].compliance(a, b);
        if (value != 0) mine.rows.add(structure_dofs[s][known[b]], value);
      }
      mine.rows.end_row();
    }
  }
  return mine;
}

/// The rows of all ranks, those of rank 0 first, and the place of those of each dof; -1: nowhere.
/// Collective.
SparseRows rows_of_all(MPI_Comm comm, const KnownRows& mine, std::span<int> row_of) {
  const int count = static_cast<int>(mine.dof.size());
  std::vector<int> counts(size_of(comm));
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  SparseRows all;
  for (int rank = 0; rank < size_of(comm); ++rank) {
    if (counts[rank] == 0) continue;
    KnownRows theirs;
    if (rank == rank_of(comm)) theirs = mine;
    broadcast_array(comm, theirs.dof, rank);
    broadcast_array(comm, theirs.rows.begin, rank);
    broadcast_array(comm, theirs.rows.column, rank);
    broadcast_array(comm, theirs.rows.value, rank);
    for (std::size_t k = 0; k < theirs.dof.size(); ++k) {
      row_of[theirs.dof[k]] = static_cast<int>(all.rows());
      for (std::size_t at = theirs.rows.begin[k]; at < theirs.rows.begin[k + 1]; ++at) {
        all.add(theirs.rows.column[at], theirs.rows.value[at]);
      }
      all.end_row();
    }
  }
  return all;
}

}  // namespace

InterfaceCompliance::InterfaceCompliance(MPI_Comm comm, const std::vector<InterfaceDof>& dofs,
                                         std::span<Trace> traces)
    : diagonal_(dofs.size(), 0.0) {
  std::vector<std::vector<int>> structure_dofs(traces.size());
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    structure_dofs[dofs[i].structure].push_back(static_cast<int>(i));
  }
  const KnownRows mine = known_rows(structure_dofs, traces, diagonal_);
  MPI_Allreduce(MPI_IN_PLACE, diagonal_.data(), static_cast<int>(diagonal_.size()), MPI_DOUBLE,
                MPI_SUM, comm);
  std::vector<int> row_of(dofs.size(), -1);
  const SparseRows all = rows_of_all(comm, mine, row_of);
  others_.reserve(dofs.size(), all.entries());
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (row_of[i] >= 0) {
      const std::size_t row = row_of[i];
      others_.column.insert(others_.column.end(), all.columns(row).begin(), all.columns(row).end());
      others_.value.insert(others_.value.end(), all.values(row).begin(), all.values(row).end());
    }
    others_.end_row();
  }
  find_groups();
}

void InterfaceCompliance::find_groups() {
  DisjointSets sets(diagonal_.size());
  for (std::size_t a = 0; a < diagonal_.size(); ++a) {
    for (const int b : moved_by(a)) sets.join(a, static_cast<std::size_t>(b));
  }
  for (std::size_t a = 0; a < diagonal_.size(); ++a) {
    group_of_.push_back(static_cast<int>(sets.root(a)));
  }
}

double InterfaceCompliance::velocity_change(std::size_t a, std::span<const double> f) const {
  if (others_.columns(a).empty()) return diagonal_[a] * f[a];
  return row_product(others_, a, f);
}

}  // namespace pounding::interactions
