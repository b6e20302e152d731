#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/saved_state.h"

/// Brings the parts of a saved state to rank 0 and back. All collective.
namespace pounding {

using SavedTables = std::map<std::string, SavedState::Table>;

/// The tables of all ranks on rank 0, the lowest rank's where several have one; empty elsewhere.
SavedTables collect_tables(MPI_Comm comm, const SavedTables& tables);

/// The tables of rank 0 on every rank.
void broadcast_tables(MPI_Comm comm, SavedTables& tables);

/// Parts that add up, rank by rank, shape (ranks, parts.size()); empty but on rank 0.
std::vector<double> gather_parts(MPI_Comm comm, const std::vector<double>& parts);

/// This rank's parts out of rank 0's table of shape (ranks that wrote it, `columns`): its own row
/// if as many ranks wrote it, else the column sums on rank 0 and zeros elsewhere.
std::vector<double> scatter_parts(MPI_Comm comm, const std::vector<double>& table,
                                  std::size_t columns);

/// Values of owned dofs, rank after rank, on rank 0; empty elsewhere.
std::vector<double> gather_owned(MPI_Comm comm, std::span<const double> values);

/// This rank's `count` values out of such an array of rank 0.
std::vector<double> scatter_owned(MPI_Comm comm, const std::vector<double>& all, std::size_t count);

}  // namespace pounding
