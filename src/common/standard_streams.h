#pragma once

namespace pounding {

/// Has the words of a program end alone, without it: a pipe that nobody reads, and a limit of the
/// size of files, are no signal any more but an error of the writing. A standard stream that is
/// closed is one that cannot be written, so that no file that is opened later gets its words. For
/// the begin of main. Rank 0 writes into the pipe of mpirun's output itself, where mpirun is on
/// this node and not asked to mark or keep the words of ranks: it would end them with their reader.
void guard_standard_streams();

}  // namespace pounding
