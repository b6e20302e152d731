#pragma once

namespace pounding {

/// Whether somebody sees the standard output as it is written. mpirun gives rank 0 a terminal of
/// its own even where its output goes to a file or a pipe: there the output of mpirun itself
/// counts.
bool is_watched();

/// Columns of the terminal of the standard output, 80 where it does not say.
int terminal_width();

}  // namespace pounding
