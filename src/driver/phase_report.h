#pragma once

#include <cstddef>
#include <vector>

#include <mpi.h>

#include "common/profile.h"

namespace pounding {

/// Time and memory of one phase over all ranks.
struct PhaseUse {
  double seconds = 0;       ///< wall time, largest over the ranks [s]
  double peak = 0;          ///< resident memory, sum of the ranks' largest [bytes]
  double largest_rank = 0;  ///< largest of one rank [bytes]
  double held = 0;          ///< at the end of the phase, all ranks together [bytes]
};

struct PhaseReport {
  std::vector<PhaseUse> phases;  ///< per Phase; memory of those of the start-up and of `step` only
  double peak = 0;               ///< of the whole run, sum of the ranks' largest [bytes]
  /// Largest memory of Gmsh's processes, which have gone when the ranks take theirs [bytes].
  double mesher = 0;
  std::size_t dofs = 0;  ///< free ones, for memory per dof
};

/// Time and memory that the ranks noted. Collective.
PhaseReport report_phases(MPI_Comm comm, const Profile& profile, std::size_t dofs);

}  // namespace pounding
