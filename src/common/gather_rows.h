#pragma once

#include <vector>

#include <mpi.h>

namespace pounding {

/// Rows of all ranks, one after the other, on all of them. Collective.
std::vector<double> gather_rows(MPI_Comm comm, const std::vector<double>& rows);

}  // namespace pounding
