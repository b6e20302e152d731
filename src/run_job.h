#pragma once

#include <span>
#include <string>

#include <mpi.h>

namespace pounding {

/// The whole job of the program `pounding`, as a function of a communicator and the words behind
/// the program's name: help, version, a run or an ensemble. Returns the exit status, the same on
/// every rank: 0, 1 after an error, 2 where a signal stopped the run; the message of an error is
/// one line on stderr from the first rank. PETSc is started on `comm` and ended, and the process is
/// left as it was found: handlers of signals, mode of floating-point numbers, vector unit. Needs
/// MPI, and prepare_hdf5 (io/hdf5_file.h) before MPI was started. Lack of memory and internal
/// errors end all processes of MPI, since a rank may fail alone. Collective.
int run_job(MPI_Comm comm, std::span<const std::string> words);

}  // namespace pounding
