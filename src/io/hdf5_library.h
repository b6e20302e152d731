#pragma once

namespace pounding {

/// Prepares HDF5 before its first use: it shall report errors by the values of its functions only,
/// and not write to files that failed once more when the program ends. Any number of calls, the
/// first before MPI_Init: where MPI is there when HDF5 begins, it closes its files at MPI_Finalize,
/// and falls over those that a full disk left half closed.
void prepare_hdf5();

}  // namespace pounding
